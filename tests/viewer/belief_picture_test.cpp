// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/error.h>
#include <homeward/viewer/belief_picture.h>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace homeward
{
namespace
{

/** Mean darkness of the columns of the drawing, leftmost and rightmost tenth. */
double darkness(const cv::Mat &picture, double from, double to)
{
  cv::Mat gray;
  cv::cvtColor(picture, gray, cv::COLOR_BGR2GRAY);
  constexpr int kLeft = 44;
  constexpr int kTop = 46;
  const cv::Mat drawing = gray(cv::Rect(kLeft, kTop, 480, gray.rows - kTop - 12));
  return 255.0 -
         cv::mean(drawing.colRange(static_cast<int>(from * 480), static_cast<int>(to * 480)))[0];
}

TEST(BeliefPicture, isDarkWhereTheBeliefIs)
{
  std::vector<BeliefRow> rows;
  for (int view = 0; view < 4; ++view) {
    std::vector<double> belief(20, 0.0); // 24 pixels each
    belief[1] = 1.0;
    rows.push_back({belief, std::nullopt});
  }
  const cv::Mat picture = beliefPicture(rows);
  EXPECT_GT(darkness(picture, 0.05, 0.1), 150.0);
  EXPECT_LT(darkness(picture, 0.5, 1.0), 20.0);
  rows.back().truth = 19;
  const cv::Mat ringed = beliefPicture(rows);
  EXPECT_GT(darkness(ringed, 0.95, 1.0), darkness(picture, 0.95, 1.0));
}

TEST(BeliefPicture, drawsManyPlacesInASizeThatCanBeLookedAt)
{
  const std::vector<BeliefRow> rows(300, {std::vector<double>(500, 0.002), 499});
  const cv::Mat picture = beliefPicture(rows);
  EXPECT_LT(picture.cols, 1300);
  EXPECT_LT(picture.rows, 1300);
}

TEST(BeliefPicture, refusesWhatCannotBeDrawn)
{
  EXPECT_THROW(beliefPicture({}), LogicError);
  EXPECT_THROW(beliefPicture({{{0.5, 0.5}, {}}, {{1.0}, {}}}), LogicError);
}

} // namespace
} // namespace homeward
