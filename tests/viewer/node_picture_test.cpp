// SPDX-License-Identifier: GPL-3.0-or-later
#include "words_apart.h"

#include <homeward/core/error.h>
#include <homeward/viewer/node_picture.h>

#include <gmock/gmock.h>
#include <opencv2/imgproc.hpp>

namespace homeward
{
namespace
{

using ::testing::HasSubstr;
using ::testing::Not;

// Place 1 has four directions and three neighbours, one of unknown length and one in an unknown
// direction:
//
//        2
//        |          (up is the heading of 1; - to 3 somehow)
//   0 -- 1
//
TopologicalMap crossing()
{
  TopologicalMap map;
  map.apply(NodeAdded{{{0}, {}, "hall"}});
  map.apply(NodeAdded{{{1},
                       {{{0}, 0.5 * kPi, 0.8, DirectionState::Driven, "leads to node 0"},
                        {{1}, 0.0, 0.4, DirectionState::Driven, "led to node 2"},
                        {{2}, -0.5 * kPi, 0.6, DirectionState::Open},
                        {{3}, -0.5 * kPi - 0.1, 0.2, DirectionState::Closed, "too narrow"}},
                       "kitchen"}});
  map.apply(NodeAdded{{{2}}});
  map.apply(NodeAdded{{{3}}});
  map.apply(EdgeAdded{{{0}, {0}, {1}, 0.0, 0.5 * kPi, 2.5, {4, 3, 12.5, "timed out", 9.0}}});
  map.apply(EdgeAdded{{{1}, {1}, {2}, 0.0, kPi}});
  map.apply(EdgeAdded{{{2}, {1}, {3}, std::nullopt, 0.0, 1.5}});
  return map;
}

NodePicture grayPicture()
{
  NodePicture picture;
  picture.title = "Place 1 kitchen of lab";
  picture.panorama = Panorama{cv::Mat(160, 720, CV_8UC1, cv::Scalar(99)), {}};
  picture.alike = {{{2}, 0.25, 0.93}, {{0}, 0.75, 0.01}};
  return picture;
}

/** Middle of the pixels of one colour in a part of a picture. */
cv::Point2d middleOf(const cv::Mat &part, const cv::Scalar &bgr)
{
  cv::Mat mask;
  cv::inRange(part, bgr - cv::Scalar::all(2), bgr + cv::Scalar::all(2), mask);
  std::vector<cv::Point> points;
  cv::findNonZero(mask, points);
  EXPECT_FALSE(points.empty());
  cv::Point2d sum(0.0, 0.0);
  for (const cv::Point &point : points) {
    sum += cv::Point2d(point);
  }
  return sum / static_cast<double>(points.size());
}

TEST(NodePicture, SaysAllThatTheMapHoldsOfTheNode)
{
  const std::string svg = nodeSvg(crossing(), {1}, grayPicture());
  for (const char *words : {"Place 1 kitchen of lab", "+90 deg", "46 deg", "leads to node 0",
                            "too narrow", "0 hall", "2.50 m", "3 of 4", "12.5 s", "timed out",
                            "unknown", "0.250", "93.0 %", "open direction"}) {
    EXPECT_THAT(svg, HasSubstr(words));
  }
  EXPECT_THAT(svg, Not(HasSubstr("no panorama")));
  EXPECT_EQ(nodeSvg(crossing(), {1}, grayPicture()), svg);
}

TEST(NodePicture, HasForwardOnTopAndLeftOnTheLeft)
{
  const cv::Mat image = nodeImage(crossing(), {1}, grayPicture());
  EXPECT_EQ(image.cols, 1200);
  // Shades of sectors in the disc, which is in the left half: driven ahead and to the left, open to
  // the right. The panorama takes the upper 300 pixels.
  const cv::Mat disc = image(cv::Rect(0, 400, 550, image.rows - 400));
  const cv::Point2d driven = middleOf(disc, {245, 225, 206});
  const cv::Point2d open = middleOf(disc, {196, 224, 255});
  EXPECT_LT(driven.x + 100.0, open.x);
  EXPECT_LT(driven.y + 20.0, open.y);
  // Arrows below the panorama: the open direction at its right quarter.
  const cv::Mat scale = image(cv::Rect(0, 308, 1200, 24));
  EXPECT_NEAR(middleOf(scale, {0, 81, 230}).x, 28.0 + 0.75 * (1200.0 - 56.0), 3.0);
}

TEST(NodePicture, HasItsWordsApart)
{
  for (const int width : {800, 1000, 1200, 1600}) {
    NodePicture picture = grayPicture();
    picture.width = width;
    expectWordsApart(nodeSvg(crossing(), {1}, picture));
    expectWordsApart(nodeSvg(crossing(), {3}, picture));
  }
}

TEST(NodePicture, ClipsLongNames)
{
  TopologicalMap map = crossing();
  map.apply(NodeNamed{{2}, "the room of all those who were here before"});
  const std::string svg = nodeSvg(map, {1}, grayPicture());
  expectWordsApart(svg);
  EXPECT_THAT(svg, HasSubstr("2 the "));
  EXPECT_THAT(svg, Not(HasSubstr("here before")));
}

TEST(NodePicture, OfANodeWithoutAnythingSaysSo)
{
  const std::string svg =
      nodeSvg(crossing(), {3}, {.title = "Place 3", .panorama = {}, .alike = {}});
  EXPECT_THAT(svg, HasSubstr("no panorama is stored"));
  EXPECT_THAT(svg, HasSubstr(">none<"));
}

TEST(NodePicture, RefusesWhatItCannotDraw)
{
  EXPECT_THROW(nodeSvg(crossing(), {9}, grayPicture()), LogicError);
  NodePicture picture = grayPicture();
  picture.width = 700;
  EXPECT_THROW(nodeSvg(crossing(), {1}, picture), LogicError);
  picture = grayPicture();
  picture.panorama->image = cv::Mat(10, 10, CV_8UC1);
  EXPECT_THROW(nodeSvg(crossing(), {1}, picture), LogicError);
  picture = grayPicture();
  picture.alike = {{{9}, 0.1, 0.5}};
  EXPECT_THROW(nodeSvg(crossing(), {1}, picture), LogicError);
}

} // namespace
} // namespace homeward
