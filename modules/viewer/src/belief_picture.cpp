// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/viewer/belief_picture.h>

#include <homeward/core/error.h>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <string>

namespace homeward
{

namespace
{

const cv::Scalar kInk(60, 50, 40);
const cv::Scalar kTruth(0, 94, 213); // vermilion, BGR, of a palette for the colour-blind
const cv::Scalar kSure(110, 62, 8);  // dark blue
constexpr double kFont = 0.42;

void write(cv::Mat &picture, const std::string &text, const cv::Point &at)
{
  cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, kFont, kInk, 1, cv::LINE_AA);
}

} // namespace

cv::Mat beliefPicture(const std::vector<BeliefRow> &rows)
{
  if (rows.empty() || rows.front().belief.empty()) {
    throw LogicError("a picture of beliefs needs a view and a place");
  }
  constexpr int kLeft = 44;
  constexpr int kTop = 46;
  constexpr int kMargin = 12;
  constexpr int kLargest = 1100; // pixels of the drawing
  constexpr int kTicks = 5;
  const auto places = static_cast<int>(rows.front().belief.size());
  const auto views = static_cast<int>(rows.size());
  const int cell = std::clamp(kLargest / std::max(places, views), 2, 24);
  const cv::Size size(std::max(cell * places, 420), cell * views);
  cv::Mat picture(size.height + kTop + kMargin, size.width + kLeft + kMargin, CV_8UC3,
                  cv::Scalar::all(255));
  write(picture, "across: known places; down: views; the darker, the surer; ring: the truth",
        {kMargin, 16});
  for (int row = 0; row < views; ++row) {
    const BeliefRow &view = rows[static_cast<std::size_t>(row)];
    if (view.belief.size() != rows.front().belief.size()) {
      throw LogicError("beliefs over " + std::to_string(places) + " and over " +
                       std::to_string(view.belief.size()) + " places");
    }
    for (int place = 0; place < places; ++place) {
      const double sure = std::clamp(view.belief[static_cast<std::size_t>(place)], 0.0, 1.0);
      const cv::Scalar colour = (1.0 - sure) * cv::Scalar(245, 245, 245) + sure * kSure;
      cv::rectangle(picture, cv::Rect(kLeft + cell * place, kTop + cell * row, cell, cell), colour,
                    cv::FILLED);
    }
    if (view.truth) {
      const cv::Point middle(kLeft + cell * static_cast<int>(*view.truth) + cell / 2,
                             kTop + cell * row + cell / 2);
      cv::circle(picture, middle, std::max(2, cell / 3), kTruth, std::max(1, cell / 10),
                 cv::LINE_AA);
    }
  }
  const auto ticks = [&](int count, const auto &at) {
    const int step = std::max(1, count / kTicks);
    for (int i = 0; i < count; i += step) {
      write(picture, std::to_string(i), at(i));
    }
  };
  ticks(places, [&](int i) { return cv::Point(kLeft + cell * i + 2, kTop - 6); });
  ticks(views, [&](int i) { return cv::Point(8, kTop + cell * i + std::min(cell, 14)); });
  return picture;
}

} // namespace homeward
