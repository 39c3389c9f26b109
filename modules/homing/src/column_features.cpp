// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/homing/column_features.h>

#include "panorama_check.h"

#include <homeward/core/error.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace homeward
{

namespace
{

/** Mean of a sampled signal over an interval of (fractional) sample edges, by running sums. */
class RunningMean
{
public:
  explicit RunningMean(std::size_t size) : m_sums(size + 1, 0.0F) {}

  float *sums() { return m_sums.data(); }

  /** Integral from 0 to `edge`, which is clamped to the signal. */
  float integral(double edge) const
  {
    const double size = static_cast<double>(m_sums.size() - 1);
    const double inside = std::clamp(edge, 0.0, size);
    const auto whole = std::min(static_cast<std::size_t>(inside), m_sums.size() - 2);
    const auto part = static_cast<float>(inside - static_cast<double>(whole));
    return m_sums[whole] + part * (m_sums[whole + 1] - m_sums[whole]);
  }

  /** Integral from 0 to `edge` of the signal repeated for ever. */
  float periodicIntegral(double edge) const
  {
    const double size = static_cast<double>(m_sums.size() - 1);
    const double turns = std::floor(edge / size);
    return static_cast<float>(turns) * m_sums.back() + integral(edge - turns * size);
  }

private:
  std::vector<float> m_sums;
};

/** Log intensities, [column * height + row], column i round azimuth 2 pi i / columns. */
std::vector<float> logColumns(const cv::Mat &gray, const PanoramaGeometry &geometry,
                              const ColumnFeatureOptions &options)
{
  const auto columns = static_cast<std::size_t>(options.columns);
  const auto height = static_cast<std::size_t>(gray.rows);
  const double halfWidth = std::max(0.5, geometry.width / (2.0 * options.columns));
  std::vector<double> middles(columns);
  for (std::size_t i = 0; i < columns; ++i) {
    middles[i] = geometry.column(2.0 * kPi * static_cast<double>(i) / options.columns) + 0.5;
  }
  std::vector<float> logs(columns * height);
  RunningMean mean(static_cast<std::size_t>(gray.cols));
  for (std::size_t row = 0; row < height; ++row) {
    const auto *pixels = gray.ptr<std::uint8_t>(static_cast<int>(row));
    for (int u = 0; u < gray.cols; ++u) {
      mean.sums()[u + 1] = mean.sums()[u] + static_cast<float>(pixels[u]);
    }
    for (std::size_t i = 0; i < columns; ++i) {
      const float sum = mean.periodicIntegral(middles[i] + halfWidth) -
                        mean.periodicIntegral(middles[i] - halfWidth);
      const auto intensity = static_cast<float>(sum / (2.0 * halfWidth) + options.darkLevel);
      logs[i * height + row] = std::log(intensity);
    }
  }
  return logs;
}

/** Interval of picture rows (edges) that one cell of a column covers. */
struct RowInterval
{
  double from;
  double to;
};

/** rows + 1 cells from the top down, magnified about the horizon. */
std::vector<RowInterval> cells(const PanoramaGeometry &geometry, int rows, double magnification)
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
  std::vector<RowInterval> result;
  for (int cell = 0; cell <= rows; ++cell) {
    const double from = edge(cell);
    const double to = edge(cell + 1);
    const double middle = (from + to) / 2.0;
    const double half = std::max(0.5, (to - from) / 2.0); // narrower would show the pixel grid
    result.push_back({middle - half, middle + half});
  }
  return result;
}

/** Signed square roots of the steps from cell to cell; returns the sum of their magnitudes. */
float edges(const float *column, std::size_t height, const std::vector<RowInterval> &intervals,
            RunningMean &mean, std::vector<float> &values)
{
  for (std::size_t row = 0; row < height; ++row) {
    mean.sums()[row + 1] = mean.sums()[row] + column[row];
  }
  float above = 0.0F;
  float total = 0.0F;
  for (std::size_t cell = 0; cell < intervals.size(); ++cell) {
    const double from = std::max(0.0, intervals[cell].from);
    const double to = std::min(static_cast<double>(height), intervals[cell].to);
    const auto level = static_cast<float>((mean.integral(to) - mean.integral(from)) / (to - from));
    if (cell > 0) {
      const float step = above - level;
      values[cell - 1] = std::copysign(std::sqrt(std::abs(step)), step);
      total += std::abs(values[cell - 1]);
    }
    above = level;
  }
  return total;
}

} // namespace

void checkColumnFeatureOptions(const ColumnFeatureOptions &options)
{
  if (options.columns < 8 || options.columns > 256 || options.columns % 2 != 0) {
    throw LogicError("columns is " + std::to_string(options.columns) +
                     ", must be even and between 8 and 256");
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
  const std::vector<float> logs = logColumns(gray, panorama.geometry, options);
  const auto columns = static_cast<std::size_t>(options.columns);
  const auto rows = static_cast<std::size_t>(options.rows);
  const auto height = static_cast<std::size_t>(gray.rows);
  const auto blankSum = static_cast<float>(options.blankContrast * options.rows);

  ColumnFeatures features;
  features.options = options;
  RunningMean mean(height);
  std::vector<float> values(rows);
  std::size_t textured = 0;
  for (int m = 0; m < options.magnifications; ++m) {
    const double magnification = std::pow(options.magnificationStep, m);
    const std::vector<RowInterval> intervals =
        cells(panorama.geometry, options.rows, magnification);
    std::vector<std::uint8_t> &bytes = features.versions.emplace_back(columns * rows);
    for (std::size_t i = 0; i < columns; ++i) {
      const float sum = edges(&logs[i * height], height, intervals, mean, values);
      textured += (m == 0 && sum > blankSum) ? 1U : 0U;
      const float scale =
          static_cast<float>(kColumnUnit) * static_cast<float>(rows) / std::max(sum, blankSum);
      for (std::size_t r = 0; r < rows; ++r) {
        const float level = std::clamp(std::round(values[r] * scale), -127.0F, 127.0F);
        bytes[i * rows + r] = static_cast<std::uint8_t>(128.0F + level);
      }
    }
  }
  features.texturedShare = static_cast<double>(textured) / static_cast<double>(columns);
  return features;
}

} // namespace homeward
