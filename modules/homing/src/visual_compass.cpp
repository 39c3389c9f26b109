// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/homing/visual_compass.h>

#include "parabola.h"

#include <homeward/camera/gray_picture.h>
#include <homeward/core/error.h>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace homeward
{

namespace
{

/** Mean squared difference of shifts, gray levels squared, below which pictures tell nothing. */
constexpr double kLeastVariation = 0.25;
/** The same of edges, whose mean square is 1 where there are any. */
constexpr double kLeastEdgeVariation = 0.05;
/** Added to gray levels before the logarithm: noise in the dark is no edge. */
constexpr double kDarkLevel = 4.0;
/** Mean square of the edges of a band, log intensity, below which it is blank. */
constexpr double kBlankBand = 1e-5;

/** CV_32F, bands x width. */
cv::Mat bandsOf(const cv::Mat &gray, int bands)
{
  cv::Mat levels;
  if (bands > 0) {
    cv::resize(gray, levels, {gray.cols, bands}, 0.0, 0.0, cv::INTER_AREA);
    levels.convertTo(levels, CV_32F);
  }
  else {
    gray.convertTo(levels, CV_32F);
  }
  return levels;
}

/** Differences of the next columns' log intensities, each row of mean square 1 or zero. */
cv::Mat edgesOf(const cv::Mat &levels)
{
  cv::Mat logs = levels + kDarkLevel;
  cv::log(logs, logs);
  cv::Mat wrapped;
  cv::copyMakeBorder(logs, wrapped, 0, 0, 1, 1, cv::BORDER_WRAP);
  cv::Mat edges = wrapped.colRange(2, wrapped.cols) - wrapped.colRange(0, wrapped.cols - 2);
  for (int row = 0; row < edges.rows; ++row) {
    cv::Mat band = edges.row(row);
    const double square = band.dot(band) / band.cols;
    band *= square > kBlankBand ? 1.0 / std::sqrt(square) : 0.0;
  }
  return edges;
}

/** Mean squared difference per element for every shift; CV_32F, overwritten. */
std::vector<double> shiftDifferences(cv::Mat c, cv::Mat s)
{
  const double energy = c.dot(c) + s.dot(s);
  const auto elements = static_cast<double>(c.total());
  cv::dft(c, c, cv::DFT_ROWS);
  cv::dft(s, s, cv::DFT_ROWS);
  cv::Mat products;
  cv::mulSpectrums(c, s, products, cv::DFT_ROWS, true);
  // The inverse is linear: one transform of the sum over rows.
  cv::Mat sum;
  cv::reduce(products, sum, 0, cv::REDUCE_SUM, CV_64F);
  cv::Mat correlation;
  cv::dft(sum, correlation, cv::DFT_INVERSE | cv::DFT_SCALE | cv::DFT_REAL_OUTPUT);
  std::vector<double> differences;
  differences.reserve(static_cast<std::size_t>(correlation.cols));
  for (int k = 0; k < correlation.cols; ++k) {
    differences.push_back((energy - 2.0 * correlation.at<double>(0, k)) / elements);
  }
  return differences;
}

} // namespace

std::optional<CompassReading> visualCompass(const Panorama &current, const Panorama &snapshot,
                                            const CompassOptions &options)
{
  if (!(current.geometry == snapshot.geometry)) {
    throw LogicError("the visual compass needs two panoramas of the same geometry");
  }
  if (options.bands < 0 || options.bands > current.geometry.height) {
    throw LogicError("the visual compass cannot make " + std::to_string(options.bands) +
                     " bands of " + std::to_string(current.geometry.height) + " rows");
  }
  const auto compared = [&](const Panorama &panorama) {
    const cv::Mat bands = bandsOf(grayPicture(panorama), options.bands);
    return options.edges ? edgesOf(bands) : bands;
  };
  const std::vector<double> differences = shiftDifferences(compared(current), compared(snapshot));
  const std::size_t width = differences.size();
  const auto best = std::min_element(differences.begin(), differences.end());
  const double worst = *std::max_element(differences.begin(), differences.end());
  if (worst - *best < (options.edges ? kLeastEdgeVariation : kLeastVariation)) {
    return std::nullopt;
  }
  double mean = 0.0;
  for (const double difference : differences) {
    mean += difference / static_cast<double>(width);
  }
  const auto k = static_cast<std::size_t>(best - differences.begin());
  const double vertex =
      parabolaVertex(differences[(k + width - 1) % width], *best, differences[(k + 1) % width]);
  const double shift = static_cast<double>(k) + vertex;
  CompassReading reading;
  reading.headingChange = wrapAngle(2.0 * kPi * shift / static_cast<double>(width));
  reading.confidence = std::clamp(1.0 - *best / mean, 0.0, 1.0);
  return reading;
}

} // namespace homeward
