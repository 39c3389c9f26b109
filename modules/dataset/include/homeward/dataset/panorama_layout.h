// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/panorama.h>

#include <string>

namespace homeward
{

/** How the panoramas of a data set lie in their pictures, whoever made them. */
struct PanoramaLayout
{
  /** How rows lie to elevations. */
  enum class Projection
  {
    Equirectangular, ///< rows evenly spaced in elevation
    Cylindrical      ///< rows evenly spaced in the tangent of elevation
  };
  /** Which way columns grow. */
  enum class Columns
  {
    Clockwise,       ///< as a person standing there sees it
    CounterClockwise ///< as seen from outside
  };
  Projection projection = Projection::Equirectangular; ///< how rows lie to elevations
  Columns columns = Columns::Clockwise;                ///< which way columns grow
  double elevationMin = radians(-45.0);                ///< lower edge of the last row, radians
  double elevationMax = radians(35.0);                 ///< upper edge of row 0, radians
  double forwardColumn = 359.5; ///< (fractional) column whose centre shows straight ahead
};

/** The layout that Homeward's own panoramas have. */
PanoramaLayout layoutOf(const PanoramaGeometry &geometry);

/** Homeward's geometry for pictures of a layout, `size` pixels each. */
PanoramaGeometry geometryOf(const PanoramaLayout &layout, const cv::Size &size);

/**
 * A picture of that layout as a panorama of geometryOf() it, bilinear; pixels are moved as they are
 * where the layouts agree.
 * @throw LogicError for an empty picture
 */
Panorama toPanorama(const cv::Mat &picture, const PanoramaLayout &layout);

/**
 * Reads `panorama.yaml`: `projection: equirectangular|cylindrical`, `elevation_min_deg`,
 * `elevation_max_deg`, `forward_column`, `columns: clockwise|counterclockwise`, all needed.
 * @param origin the file's name, for messages
 * @throw ConfigError naming file, key and value
 */
PanoramaLayout parsePanoramaLayout(const std::string &yaml, const std::string &origin);

/** The text that parsePanoramaLayout() reads back. */
std::string formatPanoramaLayout(const PanoramaLayout &layout);

} // namespace homeward
