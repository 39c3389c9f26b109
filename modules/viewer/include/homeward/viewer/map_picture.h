// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/pose2.h>
#include <homeward/topology/map.h>

#include <opencv2/core/mat.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace homeward
{

/** The floor under a map, seen from above, x to the right and y up. */
struct FloorPicture
{
  cv::Mat image; ///< CV_8UC1: below 100 an obstacle, 250 and above floor to drive on, else neither
  Eigen::Vector2d origin{0.0, 0.0}; ///< lower left corner of the picture, metres, world frame
  double resolution = 0.05;         ///< side of a pixel, metres
};

/** What a picture of a map shows besides the map. */
struct MapPicture
{
  std::string title;  ///< above the picture; empty for none
  int width = 1200;   ///< of the picture, pixels; the height follows
  bool legend = true; ///< below the picture
  /** World poses of the nodes, metres and radians; when empty, layOut() finds some. */
  std::map<NodeId, Pose2> poses;
  std::optional<FloorPicture> floor;       ///< under the map; none where it is unknown
  std::vector<Eigen::Vector2d> trajectory; ///< where the robot drove, metres, world frame
  std::vector<NodeId> route;               ///< a planned way to emphasise
  std::optional<Pose2> robot;              ///< where it is now, world frame
};

/**
 * A map as SVG: places with number and heading tick, ways, directions as small arrows (hollow:
 * open, filled: driven, gray: closed). The same input gives the same text.
 * @throw LogicError when a node has no pose though others have, or the width is below 200
 */
std::string mapSvg(const TopologicalMap &map, const MapPicture &picture);

/** The same as a picture, CV_8UC3 BGR. */
cv::Mat mapImage(const TopologicalMap &map, const MapPicture &picture);

} // namespace homeward
