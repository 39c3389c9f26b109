// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/viewer/map_picture.h>

#include <opencv2/core/mat.hpp>

#include <optional>
#include <string>
#include <vector>

namespace homeward
{

/** A home vector where it was found. */
struct HomeArrow
{
  Eigen::Vector2d place;   ///< metres, world frame
  double direction = 0.0;  ///< towards home as answered, radians, world frame
  double error = 0.0;      ///< of the direction, radians, in [0, pi]
  double confidence = 1.0; ///< 0 to 1; arrows below 0.1 are hollow
};

/** The home vectors around one home. */
struct HomeVectorField
{
  Eigen::Vector2d home;                  ///< metres, world frame
  std::vector<HomeArrow> arrows;         ///< each where it was found
  std::vector<Eigen::Vector2d> way = {}; ///< driven, metres, world frame; its start is a dot
};

/** What a picture of home vectors shows. */
struct HomeVectorPicture
{
  std::string title;                   ///< above the picture; empty for none
  int panelWidth = 360;                ///< pixels
  int columns = 3;                     ///< panels side by side
  double reach = 2.8;                  ///< metres from the home to a panel's sides
  std::optional<FloorPicture> floor;   ///< under the arrows
  std::vector<HomeVectorField> fields; ///< a panel each
};

/**
 * A panel for each home, the home in its middle, an arrow at each place: green below 15 degrees of
 * error, amber below 45, orange below 90, red beyond. SVG; the same input gives the same text.
 * @throw LogicError without fields, or when width, columns or reach are not positive
 */
std::string homeVectorSvg(const HomeVectorPicture &picture);

/** The same as a picture, CV_8UC3 BGR. */
cv::Mat homeVectorImage(const HomeVectorPicture &picture);

} // namespace homeward
