// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/angle.h>
#include <homeward/core/error.h>
#include <homeward/viewer/mission_picture.h>

#include <gmock/gmock.h>
#include <opencv2/core.hpp>

#include <algorithm>

namespace homeward
{
namespace
{

const cv::Scalar kRoute(92, 24, 194); // the arrow home
const cv::Scalar kWay(192, 101, 21);  // the speed that was driven
const cv::Scalar kTold(158, 158, 158);

/** Pixels of one colour. */
std::vector<cv::Point> pixelsOf(const cv::Mat &image, const cv::Scalar &colour)
{
  cv::Mat mask;
  cv::inRange(image, colour - cv::Scalar::all(2), colour + cv::Scalar::all(2), mask);
  std::vector<cv::Point> points;
  cv::findNonZero(mask, points);
  return points;
}

double meanColumn(const std::vector<cv::Point> &points)
{
  double sum = 0.0;
  for (const cv::Point &point : points) {
    sum += point.x;
  }
  return sum / static_cast<double>(points.size());
}

bool same(const cv::Mat &a, const cv::Mat &b)
{
  return a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0.0;
}

/** A view of grey alone, with a place 30 degrees to the left as the goal. */
MissionScene sceneHome()
{
  MissionScene scene;
  scene.view.geometry.width = 720;
  scene.view.image = cv::Mat(160, 720, CV_8UC1, cv::Scalar(100));
  scene.goal = "node 3";
  scene.home = radians(30.0);
  return scene;
}

/** Half a minute in which it drives at 0.3 m/s and turns left, told somewhat more. */
MissionScene sceneDriving()
{
  MissionScene scene;
  for (int i = 0; i < 300; ++i) {
    scene.speeds.push_back({0.1 * i, {0.45, 0.6}, {0.3, 0.4}});
  }
  return scene;
}

TEST(SightImage, PointsHomeWhereTheGoalIs)
{
  MissionScene scene = sceneHome();
  const cv::Mat image = sightImage(scene, 1280);
  EXPECT_EQ(image.cols, 1280);
  const std::vector<cv::Point> arrow = pixelsOf(image, kRoute);
  ASSERT_GT(arrow.size(), 500U);
  // Ahead is the middle, left is on the left.
  EXPECT_NEAR(meanColumn(arrow), 640.0 - 1280.0 * 30.0 / 360.0, 2.0);

  scene.home.reset();
  EXPECT_TRUE(pixelsOf(sightImage(scene, 1280), kRoute).empty());
}

TEST(SightImage, SaysWhichPlaceItMayBe)
{
  MissionScene scene = sceneHome();
  const cv::Mat without = sightImage(scene, 900);
  scene.alike = {{NodeId{4}, 0.8}, {NodeId{2}, 0.1}};
  EXPECT_FALSE(same(sightImage(scene, 900), without));
}

TEST(SightImage, TakesColourAndNoPictureAtAll)
{
  MissionScene scene = sceneHome();
  scene.view.image = cv::Mat(160, 720, CV_8UC3, cv::Scalar(10, 200, 30));
  EXPECT_FALSE(pixelsOf(sightImage(scene, 720), cv::Scalar(10, 200, 30)).empty());
  scene.view.image.release();
  EXPECT_EQ(sightImage(scene, 720).cols, 720);
}

TEST(SightImage, NeedsRoom)
{
  EXPECT_THROW(sightImage(sceneHome(), 399), LogicError);
}

TEST(SpeedImage, ShowsWhatWasToldAndWhatWasDriven)
{
  const cv::Mat image = speedImage(sceneDriving(), 400, 420);
  EXPECT_EQ(image.size(), cv::Size(400, 420));
  const auto highest = [&](const cv::Scalar &colour) {
    int row = image.rows;
    for (const cv::Point &point : pixelsOf(image, colour)) {
      row = std::min(row, point.y);
    }
    return row;
  };
  // The upper half is the speed: 0.6 m/s at row 40, 0 in the middle of 150 rows.
  EXPECT_NEAR(highest(kTold), 40.0 + 75.0 * (1.0 - 0.45 / 0.6), 3.0);
  EXPECT_NEAR(highest(kWay), 40.0 + 75.0 * (1.0 - 0.3 / 0.6), 3.0);
}

TEST(SpeedImage, ForgetsWhatWasLongerAgo)
{
  MissionScene scene = sceneDriving();
  const std::size_t before = pixelsOf(speedImage(scene, 400, 420), kWay).size();
  for (SpeedSample &sample : scene.speeds) {
    sample.seconds -= 1000.0;
  }
  scene.speeds.push_back({0.0, {}, {}});
  EXPECT_LT(pixelsOf(speedImage(scene, 400, 420), kWay).size(), before / 4);
}

TEST(SpeedImage, NeedsRoom)
{
  EXPECT_THROW(speedImage(sceneDriving(), 199, 420), LogicError);
  EXPECT_THROW(speedImage(sceneDriving(), 400, 199), LogicError);
}

TEST(MissionImages, KeepTheirSizesWhateverIsKnown)
{
  MissionScene known = sceneHome();
  known.speeds = sceneDriving().speeds;
  known.scan = Scan{{}, -0.5 * kPi, kPi / 180.0, 8.0, std::vector<float>(181, 3.0F)};
  TopologicalMap map;
  map.apply(NodeAdded{{{0}, {}}});
  map.apply(NodeAdded{{{1}, {}}});
  map.apply(EdgeAdded{{{0}, {0}, {1}, 0.0, kPi}});
  known.map = std::make_shared<const TopologicalMap>(map);
  known.poses = {{{0}, {0.0, 0.0, 0.0}}, {{1}, {4.0, 1.0, 0.0}}};
  known.robot = Pose2{-3.0, 2.0, 1.0};
  known.route = {{0}, {1}};

  const std::vector<TitledImage> nothing = missionImages({});
  const std::vector<TitledImage> all = missionImages(known);
  ASSERT_EQ(nothing.size(), all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(nothing[i].image.size(), all[i].image.size()) << all[i].title;
    EXPECT_EQ(all[i].image.type(), CV_8UC3) << all[i].title;
    EXPECT_FALSE(same(nothing[i].image, all[i].image)) << all[i].title;
  }
  EXPECT_EQ(missionImage({}).size(), cv::Size(kMissionWidth, kMissionHeight));
  EXPECT_EQ(missionImage(known).size(), cv::Size(kMissionWidth, kMissionHeight));
}

TEST(MissionImage, SaysWhatItDoesAndWhy)
{
  MissionScene scene;
  const cv::Mat before = missionImage(scene);
  scene.state = "drives where it is open";
  scene.reason = std::string(400, 'x'); // longer than the picture is wide
  EXPECT_FALSE(same(missionImage(scene), before));
}

} // namespace
} // namespace homeward
