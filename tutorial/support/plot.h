// SPDX-License-Identifier: GPL-3.0-or-later
// A plot of a heading error over time.
#pragma once

#include <opencv2/imgproc.hpp>

#include <string>
#include <vector>

/** Error over time, a dot for every picture. */
inline cv::Mat plot(const std::vector<double> &degreesOff, double period)
{
  cv::Mat picture(260, 640, CV_8UC3, cv::Scalar(255, 255, 255));
  const auto at = [](double seconds, double value) {
    return cv::Point(cvRound(60.0 + 70.0 * seconds), cvRound(215.0 - 1.4 * value));
  };
  const auto write = [&](const std::string &text, const cv::Point &where) {
    cv::putText(picture, text, where, cv::FONT_HERSHEY_SIMPLEX, 0.45, {0, 0, 0}, 1, cv::LINE_AA);
  };
  for (int value = 0; value <= 120; value += 40) {
    cv::line(picture, at(0.0, value), at(8.0, value), {210, 210, 210});
    write(std::to_string(value), at(0.0, value) + cv::Point(-35, 5));
  }
  for (int seconds = 0; seconds <= 8; seconds += 2) {
    write(std::to_string(seconds), at(seconds, 0.0) + cv::Point(-4, 20));
  }
  write("heading error, degrees", {60, 20});
  write("s", {632, 235});
  for (std::size_t i = 0; i < degreesOff.size(); ++i) {
    const cv::Point here = at(static_cast<double>(i) * period, degreesOff[i]);
    cv::circle(picture, here, 3, {180, 110, 0}, cv::FILLED, cv::LINE_AA);
  }
  return picture;
}
