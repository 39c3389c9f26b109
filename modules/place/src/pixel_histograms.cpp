// SPDX-License-Identifier: GPL-3.0-or-later
#include "signature_values.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>

namespace homeward
{

namespace
{

constexpr int kGrayLevels = 256;
constexpr int kBands = 8;
constexpr int kBandLevels = 32;
constexpr int kHues = 16;
constexpr int kSaturations = 4;
constexpr int kValues = 4;
constexpr int kOpponents = 8; // of each of the two
constexpr int kBrightnesses = 4;
/** OpenCV's hues of 8 bits end before this. */
constexpr int kHueEnd = 180;
/** Colours beyond this share of the brightness are as good as pure. */
constexpr float kPureOpponent = 0.4F;
/** Added to brightness (0 to 765), so that noise in the dark has no colour. */
constexpr float kDarkBrightness = 12.0F;

int levelOf(int value, int end, int levels)
{
  return value * levels / end;
}

/** Bin of a colour difference from -kPureOpponent to kPureOpponent; no difference is a middle. */
int opponentLevel(float difference)
{
  const float share = (difference / kPureOpponent + 1.0F) / 2.0F;
  return std::clamp(cvRound(share * (kOpponents - 1)), 0, kOpponents - 1);
}

} // namespace

std::vector<float> grayHistogram(const cv::Mat &gray)
{
  std::vector<float> counts(kGrayLevels, 0.0F);
  for (int row = 0; row < gray.rows; ++row) {
    const auto *pixels = gray.ptr<std::uint8_t>(row);
    for (int u = 0; u < gray.cols; ++u) {
      counts[pixels[u]] += 1.0F;
    }
  }
  return counts;
}

std::vector<float> bandHistograms(const cv::Mat &gray)
{
  std::vector<float> counts(static_cast<std::size_t>(kBands) * kBandLevels, 0.0F);
  for (int row = 0; row < gray.rows; ++row) {
    const auto *pixels = gray.ptr<std::uint8_t>(row);
    float *band = counts.data() + levelOf(row, gray.rows, kBands) * kBandLevels;
    for (int u = 0; u < gray.cols; ++u) {
      band[levelOf(pixels[u], kGrayLevels, kBandLevels)] += 1.0F;
    }
  }
  return counts;
}

std::vector<float> hsvHistogram(const cv::Mat &bgr)
{
  cv::Mat hsv;
  cv::cvtColor(bgr, hsv, cv::COLOR_BGR2HSV);
  cv::Mat counts = cv::Mat::zeros(kHues, kSaturations * kValues, CV_32F);
  for (int row = 0; row < hsv.rows; ++row) {
    const auto *pixels = hsv.ptr<cv::Vec3b>(row);
    for (int u = 0; u < hsv.cols; ++u) {
      const int saturation = levelOf(pixels[u][1], kGrayLevels, kSaturations);
      const int value = levelOf(pixels[u][2], kGrayLevels, kValues);
      counts.at<float>(levelOf(pixels[u][0], kHueEnd, kHues), saturation * kValues + value) += 1.0F;
    }
  }
  return {counts.begin<float>(), counts.end<float>()};
}

std::vector<float> opponentHistogram(const cv::Mat &bgr)
{
  cv::Mat counts = cv::Mat::zeros(kOpponents * kOpponents, kBrightnesses, CV_32F);
  for (int row = 0; row < bgr.rows; ++row) {
    const auto *pixels = bgr.ptr<cv::Vec3b>(row);
    for (int u = 0; u < bgr.cols; ++u) {
      const int blue = pixels[u][0];
      const int green = pixels[u][1];
      const int red = pixels[u][2];
      const int brightness = red + green + blue;
      const float unit = 1.0F / (static_cast<float>(brightness) + kDarkBrightness);
      const int redGreen = opponentLevel(static_cast<float>(red - green) * unit);
      const int yellowBlue = opponentLevel(static_cast<float>(red + green - 2 * blue) * unit / 2);
      counts.at<float>(redGreen * kOpponents + yellowBlue,
                       levelOf(brightness, 3 * 255 + 1, kBrightnesses)) += 1.0F;
    }
  }
  return {counts.begin<float>(), counts.end<float>()};
}

} // namespace homeward
