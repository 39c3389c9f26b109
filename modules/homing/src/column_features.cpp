// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/homing/column_features.h>

#include <homeward/camera/gray_picture.h>
#include <homeward/core/error.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

namespace homeward
{

namespace
{

/** A place between samples, for reading running sums there. */
struct Position
{
  std::size_t whole;
  float part;
};

/** Position of a fractional sample edge, clamped to a signal of `size` samples. */
Position positionOf(double edge, std::size_t size)
{
  const double inside = std::clamp(edge, 0.0, static_cast<double>(size));
  const auto whole = std::min(static_cast<std::size_t>(inside), size - 1);
  return {whole, static_cast<float>(inside - static_cast<double>(whole))};
}

/** Integral of the signal from its beginning to a position; sums[i] is that over i samples. */
float integral(const std::vector<float> &sums, const Position &position)
{
  const float below = sums[position.whole];
  return below + position.part * (sums[position.whole + 1] - below);
}

/** A stretch of a signal, averaged by running sums. */
struct Interval
{
  Position from;
  Position to;
  float perSample; ///< 1 / length

  float mean(const std::vector<float> &sums) const
  {
    return (integral(sums, to) - integral(sums, from)) * perSample;
  }
};

/** For each column, where it stands in a row that is repeated once on its right. */
std::vector<Interval> columnIntervals(const PanoramaGeometry &geometry, int columns)
{
  const double half = std::max(0.5, geometry.width / (2.0 * columns));
  const auto size = 2U * static_cast<std::size_t>(geometry.width);
  std::vector<Interval> intervals;
  for (int i = 0; i < columns; ++i) {
    double from = geometry.column(2.0 * kPi * i / columns) + 0.5 - half;
    from += from < 0.0 ? geometry.width : 0.0;
    intervals.push_back({positionOf(from, size), positionOf(from + 2.0 * half, size),
                         static_cast<float>(0.5 / half)});
  }
  return intervals;
}

/** Log intensities, [column * height + row], column i round azimuth 2 pi i / columns. */
std::vector<float> logColumns(const cv::Mat &gray, const PanoramaGeometry &geometry,
                              const ColumnFeatureOptions &options)
{
  const std::vector<Interval> intervals = columnIntervals(geometry, options.columns);
  const auto height = static_cast<std::size_t>(gray.rows);
  const auto width = static_cast<std::size_t>(gray.cols);
  const auto dark = static_cast<float>(options.darkLevel);
  std::vector<float> logs(intervals.size() * height);
  std::vector<float> sums(2 * width + 1, 0.0F);
  for (std::size_t row = 0; row < height; ++row) {
    const auto *pixels = gray.ptr<std::uint8_t>(static_cast<int>(row));
    for (std::size_t u = 0; u < 2 * width; ++u) {
      sums[u + 1] = sums[u] + static_cast<float>(pixels[u < width ? u : u - width]);
    }
    for (std::size_t i = 0; i < intervals.size(); ++i) {
      logs[i * height + row] = std::log(intervals[i].mean(sums) + dark);
    }
  }
  return logs;
}

/** rows + 1 cells from the top down, magnified about the horizon. */
std::vector<Interval> cells(const PanoramaGeometry &geometry, int rows, double magnification)
{
  const double limit = std::min(geometry.elevationMax, -geometry.elevationMin);
  if (!(limit > 0.0) || limit >= kPi / 2.0) {
    throw LogicError("panorama shows elevations " + std::to_string(geometry.elevationMin) + " to " +
                     std::to_string(geometry.elevationMax) +
                     " rad, must show the horizon and neither pole");
  }
  const auto edge = [&](int index) {
    const double elevation = limit - 2.0 * limit * index / (rows + 1);
    return geometry.row(std::atan(std::tan(elevation) / magnification)) + 0.5;
  };
  const auto height = static_cast<std::size_t>(geometry.height);
  std::vector<Interval> result;
  for (int cell = 0; cell <= rows; ++cell) {
    const double from = edge(cell);
    const double to = edge(cell + 1);
    const double middle = (from + to) / 2.0;
    const double half = std::max(0.5, (to - from) / 2.0); // narrower would show the pixel grid
    const double top = std::max(0.0, middle - half);
    const double bottom = std::min<double>(geometry.height, middle + half);
    result.push_back({positionOf(top, height), positionOf(bottom, height),
                      static_cast<float>(1.0 / (bottom - top))});
  }
  return result;
}

/** Signed square roots of the steps from cell to cell; returns the sum of their magnitudes. */
float edges(const std::vector<float> &sums, const std::vector<Interval> &intervals,
            std::vector<float> &values)
{
  float above = intervals.front().mean(sums);
  float total = 0.0F;
  for (std::size_t cell = 1; cell < intervals.size(); ++cell) {
    const float level = intervals[cell].mean(sums);
    const float step = above - level;
    const float root = std::sqrt(std::abs(step));
    values[cell - 1] = std::copysign(root, step);
    total += root;
    above = level;
  }
  return total;
}

/** Running sums of each column of logColumns(). */
std::vector<std::vector<float>> columnSums(const std::vector<float> &logs, std::size_t height)
{
  std::vector<std::vector<float>> sums(logs.size() / height, std::vector<float>(height + 1, 0.0F));
  for (std::size_t i = 0; i < sums.size(); ++i) {
    std::partial_sum(&logs[i * height], &logs[i * height] + height, sums[i].begin() + 1);
  }
  return sums;
}

} // namespace

void checkColumnFeatureOptions(const ColumnFeatureOptions &options)
{
  if (options.columns < 8 || options.columns > 360 || options.columns % 2 != 0) {
    throw LogicError("columns is " + std::to_string(options.columns) +
                     ", must be even and between 8 and 360");
  }
  if (options.rows < 8 || options.rows > 512) {
    throw LogicError("rows is " + std::to_string(options.rows) + ", must be between 8 and 512");
  }
  if (options.magnifications < 1 || !(options.magnificationStep > 1.0)) {
    throw LogicError("magnifications must be at least 1 and their step greater than 1");
  }
}

ColumnFeatures makeColumnFeatures(const Panorama &panorama, const ColumnFeatureOptions &options)
{
  checkColumnFeatureOptions(options);
  const cv::Mat gray = grayPicture(panorama);
  const std::vector<std::vector<float>> columns =
      columnSums(logColumns(gray, panorama.geometry, options), static_cast<std::size_t>(gray.rows));
  const auto rows = static_cast<std::size_t>(options.rows);
  const auto blankSum = static_cast<float>(options.blankContrast * options.rows);
  const float unitSum = static_cast<float>(kColumnUnit) * static_cast<float>(rows);

  ColumnFeatures features;
  features.options = options;
  std::vector<float> values(rows);
  std::size_t textured = 0;
  for (int m = 0; m < options.magnifications; ++m) {
    const std::vector<Interval> intervals =
        cells(panorama.geometry, options.rows, std::pow(options.magnificationStep, m));
    std::vector<std::uint8_t> &bytes = features.versions.emplace_back(columns.size() * rows);
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const float sum = edges(columns[i], intervals, values);
      textured += (m == 0 && sum > blankSum) ? 1U : 0U;
      const float scale = unitSum / std::max(sum, blankSum);
      for (std::size_t r = 0; r < rows; ++r) {
        // Rounds: what is cut off is positive.
        const float level = std::clamp(values[r] * scale, -127.0F, 127.0F) + 128.5F;
        bytes[i * rows + r] = static_cast<std::uint8_t>(level);
      }
    }
  }
  features.texturedShare = static_cast<double>(textured) / options.columns;
  return features;
}

} // namespace homeward
