// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/dataset/panorama_layout.h>

#include <homeward/core/error.h>

#include <opencv2/imgproc.hpp>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace homeward
{

namespace
{

constexpr std::array<std::string_view, 5> kKeys{"projection", "elevation_min_deg",
                                                "elevation_max_deg", "forward_column", "columns"};

std::string word(const YAML::Node &root, const std::string &key, const std::string &origin)
{
  const YAML::Node value = root[key];
  if (!value || !value.IsScalar()) {
    throw ConfigError(origin + ": " + key + " is missing");
  }
  return value.Scalar();
}

double number(const YAML::Node &root, const std::string &key, const std::string &origin)
{
  const std::string text = word(root, key, origin);
  double value = 0.0;
  if (!YAML::convert<double>::decode(root[key], value) || !std::isfinite(value)) {
    throw ConfigError(origin + ": " + key + " must be a number, not '" + text + "'");
  }
  return value;
}

/** Whether the value is `yes`; `no` is the only other word allowed. */
bool either(const YAML::Node &root, const std::string &key, const std::string &yes,
            const std::string &no, const std::string &origin)
{
  const std::string text = word(root, key, origin);
  if (text != yes && text != no) {
    throw ConfigError(origin + ": " + key + " must be " + yes + " or " + no + ", not '" + text +
                      "'");
  }
  return text == yes;
}

PanoramaLayout layoutFrom(const YAML::Node &root, const std::string &origin)
{
  if (!root.IsMap()) {
    throw ConfigError(origin + " must be a mapping with projection, elevation_min_deg, "
                               "elevation_max_deg, forward_column and columns");
  }
  for (const auto &entry : root) {
    const auto key = entry.first.as<std::string>();
    if (std::find(kKeys.begin(), kKeys.end(), key) == kKeys.end()) {
      throw ConfigError(origin + ": unknown key '" + key + "'");
    }
  }
  PanoramaLayout layout;
  if (!either(root, "projection", "equirectangular", "cylindrical", origin)) {
    layout.projection = PanoramaLayout::Projection::Cylindrical;
  }
  if (!either(root, "columns", "clockwise", "counterclockwise", origin)) {
    layout.columns = PanoramaLayout::Columns::CounterClockwise;
  }
  layout.elevationMin = radians(number(root, "elevation_min_deg", origin));
  layout.elevationMax = radians(number(root, "elevation_max_deg", origin));
  layout.forwardColumn = number(root, "forward_column", origin);
  if (!(layout.elevationMin < 0.0 && layout.elevationMax > 0.0) ||
      std::max(-layout.elevationMin, layout.elevationMax) > radians(89.9)) {
    throw ConfigError(origin + ": elevation_min_deg must be between -89.9 and 0 and " +
                      "elevation_max_deg between 0 and 89.9: panoramas show the horizon");
  }
  return layout;
}

/** Row of a layout that shows an elevation. */
double rowOf(const PanoramaLayout &layout, double elevation, int height)
{
  if (layout.projection == PanoramaLayout::Projection::Equirectangular) {
    return (layout.elevationMax - elevation) / (layout.elevationMax - layout.elevationMin) *
               height -
           0.5;
  }
  const double top = std::tan(layout.elevationMax);
  return (top - std::tan(elevation)) / (top - std::tan(layout.elevationMin)) * height - 0.5;
}

/** Column of a layout that shows an azimuth, in [0, width). */
double columnOf(const PanoramaLayout &layout, double azimuth, int width)
{
  const double sign = layout.columns == PanoramaLayout::Columns::Clockwise ? -1.0 : 1.0;
  const double column = layout.forwardColumn + sign * azimuth / (2.0 * kPi) * width;
  return column - width * std::floor(column / width);
}

} // namespace

PanoramaLayout layoutOf(const PanoramaGeometry &geometry)
{
  PanoramaLayout layout;
  layout.elevationMin = geometry.elevationMin;
  layout.elevationMax = geometry.elevationMax;
  layout.forwardColumn = geometry.column(0.0);
  return layout;
}

PanoramaGeometry geometryOf(const PanoramaLayout &layout, const cv::Size &size)
{
  return {size.width, size.height, layout.elevationMin, layout.elevationMax};
}

Panorama toPanorama(const cv::Mat &picture, const PanoramaLayout &layout)
{
  if (picture.empty()) {
    throw LogicError("picture of a panorama is empty");
  }
  const PanoramaGeometry geometry = geometryOf(layout, picture.size());
  cv::Mat columns(picture.size(), CV_32FC1);
  cv::Mat rows(picture.size(), CV_32FC1);
  for (int v = 0; v < geometry.height; ++v) {
    const double row = rowOf(layout, geometry.elevation(v), geometry.height);
    rows.row(v).setTo(std::clamp(row, 0.0, geometry.height - 1.0));
  }
  for (int u = 0; u < geometry.width; ++u) {
    columns.col(u).setTo(columnOf(layout, geometry.azimuth(u), geometry.width));
  }
  // One column more on the right, so that the last blends into the first.
  cv::Mat closed;
  cv::copyMakeBorder(picture, closed, 0, 0, 0, 1, cv::BORDER_WRAP);
  Panorama panorama{cv::Mat(), geometry};
  cv::remap(closed, panorama.image, columns, rows, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return panorama;
}

PanoramaLayout parsePanoramaLayout(const std::string &yaml, const std::string &origin)
{
  try {
    return layoutFrom(YAML::Load(yaml), origin);
  }
  catch (const YAML::Exception &error) {
    throw ConfigError(origin + " is not YAML: " + error.what());
  }
}

std::string formatPanoramaLayout(const PanoramaLayout &layout)
{
  const bool even = layout.projection == PanoramaLayout::Projection::Equirectangular;
  const bool clockwise = layout.columns == PanoramaLayout::Columns::Clockwise;
  YAML::Emitter out;
  out.SetDoublePrecision(17);
  out << YAML::BeginMap << YAML::Key << "projection" << YAML::Value
      << (even ? "equirectangular" : "cylindrical") << YAML::Key << "elevation_min_deg"
      << YAML::Value << degrees(layout.elevationMin) << YAML::Key << "elevation_max_deg"
      << YAML::Value << degrees(layout.elevationMax) << YAML::Key << "forward_column" << YAML::Value
      << layout.forwardColumn << YAML::Key << "columns" << YAML::Value
      << (clockwise ? "clockwise" : "counterclockwise") << YAML::EndMap;
  return std::string(out.c_str()) + "\n";
}

} // namespace homeward
