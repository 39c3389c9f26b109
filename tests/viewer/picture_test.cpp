// SPDX-License-Identifier: GPL-3.0-or-later
#include "words_apart.h"
#include "xml.h"

#include <homeward/core/angle.h>
#include <homeward/core/error.h>
#include <homeward/viewer/map_picture.h>
#include <homeward/viewer/scan_picture.h>

#include <gmock/gmock.h>
#include <opencv2/core.hpp>

namespace homeward
{
namespace
{

using ::testing::HasSubstr;
using ::testing::Not;

const cv::Scalar kObstacle(90, 82, 69);
const cv::Scalar kInk(56, 50, 38);
const cv::Scalar kOpenShade(196, 224, 255);
const cv::Scalar kUnseen(237, 235, 232);
const cv::Scalar kWay(192, 101, 21);

/** Pixels of one colour. */
cv::Mat pixelsOf(const cv::Mat &image, const cv::Scalar &colour)
{
  cv::Mat mask;
  cv::inRange(image, colour - cv::Scalar::all(2), colour + cv::Scalar::all(2), mask);
  return mask;
}

/** Middle of the pixels of one colour, as shares of the picture's width and height. */
cv::Point2d middleOf(const cv::Mat &image, const cv::Scalar &colour)
{
  std::vector<cv::Point> points;
  cv::findNonZero(pixelsOf(image, colour), points);
  EXPECT_FALSE(points.empty());
  cv::Point2d sum(0.0, 0.0);
  for (const cv::Point &point : points) {
    sum += cv::Point2d(point);
  }
  const auto count = static_cast<double>(points.size());
  return {sum.x / count / image.cols, sum.y / count / image.rows};
}

/** Number of elements of one name in an SVG text, which must be well-formed. */
int count(const std::string &svg, const std::string &element)
{
  tinyxml2::XMLDocument document;
  EXPECT_EQ(document.Parse(svg.c_str()), tinyxml2::XML_SUCCESS) << document.ErrorStr();
  return childCount(*document.RootElement(), element);
}

// Three places on a floor 8 m wide and 4 m high, with a cupboard in its upper left corner:
//
//    +-----------------+
//    |##               |
//    |     0 --- 1 --- 2   (2 looks up and has an open direction ahead)
//    |                 |
//    +-----------------+
TopologicalMap threePlaces()
{
  TopologicalMap map;
  map.apply(NodeAdded{{{0}, {{{0}, 0.0, 0.3, DirectionState::Driven}}}});
  map.apply(NodeAdded{{{1}, {{{0}, 1.0, 0.3, DirectionState::Closed}}}});
  map.apply(NodeAdded{{{2}, {{{0}, 0.0, 0.3}}}});
  map.apply(EdgeAdded{{{0}, {0}, {1}, 0.0, kPi}});
  map.apply(EdgeAdded{{{1}, {1}, {2}, 0.0, 0.5 * kPi}});
  return map;
}

MapPicture floorPicture()
{
  cv::Mat floor(40, 80, CV_8UC1, cv::Scalar(255));
  floor(cv::Rect(0, 0, 10, 5)).setTo(0);
  MapPicture picture;
  picture.width = 600;
  picture.poses = {{{0}, {2.0, 2.0, 0.0}}, {{1}, {4.0, 2.0, 0.0}}, {{2}, {7.0, 2.0, 0.5 * kPi}}};
  picture.floor = FloorPicture{floor, {0.0, 0.0}, 0.1};
  return picture;
}

TEST(MapPicture, HasTheFloorTheRightWayUpAndThePlacesOnIt)
{
  const cv::Mat image = mapImage(threePlaces(), floorPicture());
  ASSERT_EQ(image.type(), CV_8UC3);
  EXPECT_EQ(image.cols, 600);
  const cv::Point2d cupboard = middleOf(image, kObstacle);
  EXPECT_LT(cupboard.x, 0.2);
  EXPECT_LT(cupboard.y, 0.3);
  // The ways lie at half the floor's height, from x = 2 m to 7 m.
  MapPicture bare = floorPicture();
  bare.legend = false;
  const cv::Mat ways = pixelsOf(mapImage(threePlaces(), bare), kWay);
  std::vector<cv::Point> points;
  cv::findNonZero(ways, points);
  double left = 1e9;
  double right = -1e9;
  for (const cv::Point &point : points) {
    left = std::min<double>(left, point.x);
    right = std::max<double>(right, point.x);
  }
  const double pixelsPerMetre = (600.0 - 56.0) / 8.0;
  EXPECT_NEAR(left, 28.0 + 2.0 * pixelsPerMetre, 16.0);
  EXPECT_NEAR(right, 28.0 + 7.0 * pixelsPerMetre, 16.0);
}

TEST(MapPicture, SvgIsWellFormedAndHasEverything)
{
  MapPicture picture = floorPicture();
  picture.title = "a < b & c";
  picture.trajectory = {{2.0, 2.0}, {3.0, 2.5}, {7.0, 2.0}};
  picture.route = {{0}, {1}};
  picture.robot = Pose2{3.0, 1.0, 0.0};
  const std::string svg = mapSvg(threePlaces(), picture);
  EXPECT_EQ(count(svg, "circle"), 3 + 1);      // places and legend
  EXPECT_EQ(count(svg, "polygon"), 3 + 3 + 2); // directions, legend, robot
  EXPECT_EQ(count(svg, "polyline"),
            2 + 3 + 1 + 1 + 1 + 1 + 3); // ways, ticks, path, route, bar, legend
  EXPECT_EQ(count(svg, "image"), 1);
  EXPECT_THAT(svg, HasSubstr("a &lt; b &amp; c"));
  EXPECT_THAT(svg, HasSubstr("3 places, 2 ways, 1 open direction<"));
  EXPECT_EQ(mapSvg(threePlaces(), picture), svg);
}

TEST(MapPicture, WithoutPosesIsLaidOutWithoutAScale)
{
  MapPicture picture = floorPicture();
  picture.poses.clear();
  const std::string svg = mapSvg(threePlaces(), picture);
  EXPECT_EQ(count(svg, "circle"), 3 + 1);
  EXPECT_EQ(count(svg, "image"), 0);
  EXPECT_THAT(svg, Not(HasSubstr(" m</text>")));
}

TEST(MapPicture, OfAnEmptyMapIsJustEmpty)
{
  EXPECT_FALSE(mapImage(TopologicalMap(), MapPicture()).empty());
}

TEST(MapPicture, RefusesWhatItCannotDraw)
{
  MapPicture picture = floorPicture();
  picture.poses.erase({1});
  EXPECT_THROW(mapSvg(threePlaces(), picture), LogicError);
  picture = floorPicture();
  picture.route = {{5}};
  EXPECT_THROW(mapSvg(threePlaces(), picture), LogicError);
  picture = floorPicture();
  picture.width = 100;
  EXPECT_THROW(mapSvg(threePlaces(), picture), LogicError);
}

TEST(MapPicture, HasItsWordsApartWhateverItsWidth)
{
  for (const int width : {300, 400, 600, 700, 800, 900, 1000, 1200, 1600}) {
    MapPicture picture = floorPicture();
    picture.width = width;
    picture.title = "lab";
    picture.trajectory = {{2.0, 2.0}, {3.0, 2.5}, {7.0, 2.0}};
    picture.route = {{0}, {1}};
    expectWordsApart(mapSvg(threePlaces(), picture));
    picture.poses.clear();
    expectWordsApart(mapSvg(threePlaces(), picture));
  }
}

TEST(MapPicture, CountsOnePlaceAsOne)
{
  TopologicalMap map;
  map.apply(NodeAdded{{{0}}});
  MapPicture picture;
  picture.title = "lab";
  EXPECT_THAT(mapSvg(map, picture), HasSubstr("1 place, 0 ways, 0 open directions"));
}

/** A full turn of far readings but for what `range` says. */
template <class Range> Scan scanOf(const Range &range)
{
  Scan scan;
  scan.angleMin = -kPi;
  scan.angleStep = radians(1.0);
  scan.rangeMax = 8.0;
  for (int i = 0; i < 360; ++i) {
    scan.ranges.push_back(static_cast<float>(range(scan.angle(static_cast<std::size_t>(i)))));
  }
  return scan;
}

TEST(ScanPicture, HasForwardOnTopAndLeftOnTheLeft)
{
  ScanPicture picture;
  picture.width = 400;
  picture.range = 4.0;
  const auto wallAt = [](double bearing) {
    return scanOf(
        [&](double angle) { return std::abs(wrapAngle(angle - bearing)) < 0.3 ? 3.0 : 8.0; });
  };
  const auto hitsOf = [&](double bearing) {
    const cv::Mat image = scanImage(wallAt(bearing), picture);
    return middleOf(image.rowRange(0, image.rows - 64), kInk);
  };
  EXPECT_LT(hitsOf(0.0).y, 0.3);
  EXPECT_NEAR(hitsOf(0.0).x, 0.5, 0.05);
  EXPECT_LT(hitsOf(0.5 * kPi).x, 0.3);
  EXPECT_GT(hitsOf(-0.5 * kPi).x, 0.7);
  EXPECT_GT(hitsOf(kPi).y, 0.7);
}

TEST(ScanPicture, ShowsOpenDirectionsAndWhatIsUnknown)
{
  const Scan scan = scanOf([](double angle) {
    return angle > 0.5 && angle < 2.0 ? static_cast<double>(kUnknownRange) : 6.0;
  });
  ScanPicture picture;
  picture.width = 400;
  picture.range = 6.0;
  picture.openDirections = {{-0.5 * kPi, 0.8, 6.0}};
  const cv::Mat image = scanImage(scan, picture);
  const cv::Mat disc = image.rowRange(0, image.rows - 64); // above the legend
  EXPECT_GT(middleOf(disc, kOpenShade).x, 0.6);
  EXPECT_LT(middleOf(disc.colRange(0, 200), kUnseen).y, 0.5);

  const std::string svg = scanSvg(scan, picture);
  EXPECT_THAT(svg, HasSubstr("-90 deg"));
  EXPECT_EQ(scanSvg(scan, picture), svg);
  EXPECT_GT(count(svg, "circle"), 200);
}

TEST(ScanPicture, RefusesWhatItCannotDraw)
{
  const Scan scan;
  EXPECT_NO_THROW(scanSvg(scan, {}));
  EXPECT_THROW(scanSvg(scan, {.title = "", .width = 10, .openDirections = {}}), LogicError);
  EXPECT_THROW(scanSvg(scan, {.title = "", .range = -1.0, .openDirections = {}}), LogicError);
}

} // namespace
} // namespace homeward
