// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/homing/visual_compass.h>

#include "panorama_check.h"
#include "parabola.h"

#include <homeward/core/error.h>

#include <opencv2/core.hpp>

#include <algorithm>
#include <vector>

namespace homeward
{

namespace
{

/** Mean squared difference of shifts, gray levels squared, below which pictures tell nothing. */
constexpr double kLeastVariation = 0.25;

/** Mean squared difference per pixel for every shift. */
std::vector<double> shiftDifferences(const cv::Mat &current, const cv::Mat &snapshot)
{
  cv::Mat c;
  cv::Mat s;
  current.convertTo(c, CV_32F);
  snapshot.convertTo(s, CV_32F);
  const double energy = c.dot(c) + s.dot(s);
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
    differences.push_back((energy - 2.0 * correlation.at<double>(0, k)) /
                          static_cast<double>(current.total()));
  }
  return differences;
}

} // namespace

std::optional<CompassReading> visualCompass(const Panorama &current, const Panorama &snapshot)
{
  if (!(current.geometry == snapshot.geometry)) {
    throw LogicError("the visual compass needs two panoramas of the same geometry");
  }
  const std::vector<double> differences =
      shiftDifferences(grayPicture(current), grayPicture(snapshot));
  const std::size_t width = differences.size();
  const auto best = std::min_element(differences.begin(), differences.end());
  const double worst = *std::max_element(differences.begin(), differences.end());
  if (worst - *best < kLeastVariation) {
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
