// SPDX-License-Identifier: GPL-3.0-or-later
#include "synthetic_room.h"

#include <homeward/calib/bearing_tracks.h>
#include <homeward/core/error.h>

#include <gmock/gmock.h>

#include <map>

namespace homeward
{
namespace
{

/** A full turn in steps of 10 degrees, then 1.5 m in steps of 0.1 m; oMr is wMr. */
std::vector<DriveView> drive(const Pose2 &rMp)
{
  const SyntheticRoom room(3, 7.0, 5.0);
  std::vector<Pose2> poses;
  poses.reserve(52);
  for (int i = 0; i < 36; ++i) {
    poses.push_back({-0.8, 0.3, wrapAngle(radians(10.0 * i))});
  }
  for (int i = 0; i <= 15; ++i) {
    poses.push_back({-0.8 + 0.1 * i, 0.3, 0.0});
  }
  std::vector<DriveView> views;
  views.reserve(poses.size());
  for (const Pose2 &oMr : poses) {
    views.push_back({oMr, room.view(oMr * rMp)});
  }
  return views;
}

TEST(BearingTracks, LandmarksKeepTheirBearingInTheWorldWhenTheRobotTurns)
{
  const auto views = drive({});
  const auto samples = trackBearings(views);
  ASSERT_EQ(samples.size(), views.size());
  std::map<int, double> first;
  std::map<int, int> sights;
  int aside = 0;
  int all = 0;
  for (std::size_t i = 0; i < 36; ++i) { // on the spot
    for (const LandmarkBearing &seen : samples[i].bearings) {
      const double world = wrapAngle(seen.bearing + samples[i].oMr.heading);
      const auto [entry, isNew] = first.try_emplace(seen.landmark, world);
      ++sights[seen.landmark];
      all += isNew ? 0 : 1;
      aside += std::abs(wrapAngle(world - entry->second)) > radians(0.5) ? 1 : 0;
    }
  }
  EXPECT_GT(all, 36 * 50);
  EXPECT_LT(aside, 0.03 * all);
  EXPECT_GT(std::count_if(sights.begin(), sights.end(), [](auto &s) { return s.second == 36; }),
            30);
}

TEST(BearingTracks, TellTheMountWithoutAnythingPutUp)
{
  for (const Pose2 &truth : {Pose2{0.2, 0.0, radians(30.0)}, Pose2{-0.1, 0.08, radians(-150.0)}}) {
    const MountEstimate found = calibrateMount(trackBearings(drive(truth)));
    EXPECT_NEAR(found.rMp.x, truth.x, 0.01);
    EXPECT_NEAR(found.rMp.y, truth.y, 0.01);
    EXPECT_NEAR(wrapAngle(found.rMp.heading - truth.heading), 0.0, radians(0.3));
    EXPECT_GT(found.landmarks, 100);
  }
}

TEST(BearingTracks, TakeNothingFromWhereThePictureShowsNoScene)
{
  auto views = drive({});
  const PanoramaGeometry &geometry = views[0].panorama.geometry;
  cv::Mat visible(geometry.height, geometry.width, CV_8UC1, cv::Scalar(0));
  visible.colRange(0, 100) = 255;
  views.resize(1);
  const auto samples = trackBearings(views, visible);
  EXPECT_GT(samples[0].bearings.size(), 5);
  for (const LandmarkBearing &seen : samples[0].bearings) {
    EXPECT_LT(geometry.column(seen.bearing), 100.0);
  }
}

TEST(BearingTracks, RefuseAFrozenCamera)
{
  auto views = drive({});
  views.resize(3);
  views[2].panorama = views[1].panorama;
  EXPECT_THROW(trackBearings(views), ConfigError);
  views[2].oMr = views[1].oMr;
  EXPECT_NO_THROW(trackBearings(views));
}

TEST(BearingTracks, RefuseMixedPictures)
{
  auto views = drive({});
  views.resize(2);
  views[1].panorama.geometry.width = 360;
  EXPECT_THROW(trackBearings(views), LogicError);
  EXPECT_TRUE(trackBearings({}).empty());
}

} // namespace
} // namespace homeward
