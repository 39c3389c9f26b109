// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/calib/mount.h>
#include <homeward/core/error.h>
#include <homeward/core/random.h>

#include <gmock/gmock.h>

#include <Eigen/LU>

#include <cmath>

namespace homeward
{
namespace
{

constexpr double kNoise = 0.005; // radians
constexpr int kLandmarks = 30;

/** What of a turn of 360 degrees on the spot and a straight line of 1.5 m is driven. */
struct Drive
{
  double turn = 2.0 * kPi;
  double way = 1.5;
  double outliers = 0.0;
  double slip = 0.0;        ///< share by which the robot turns more than odometry says
  double round = 2.0 * kPi; ///< angle in which landmarks stand
};

std::vector<MountSample> driven(const Pose2 &rMp, const Drive &plan, std::uint64_t seed)
{
  Random random(seed, 0);
  std::vector<Eigen::Vector2d> landmarks;
  for (int i = 0; i < kLandmarks; ++i) {
    const double angle = plan.round * i / kLandmarks + random.uniform(-0.2, 0.2);
    landmarks.emplace_back(random.uniform(1.5, 4.0) *
                           Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  std::vector<Pose2> poses;
  poses.reserve(40);
  for (int i = 0; i < 24; ++i) {
    poses.push_back({0.0, 0.0, wrapAngle(plan.turn * i / 24.0)});
  }
  const double heading = wrapAngle(plan.turn);
  for (int i = 0; i <= 15; ++i) {
    const double along = plan.way * i / 15.0;
    poses.push_back({along * std::cos(heading), along * std::sin(heading), heading});
  }
  std::vector<MountSample> drive;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const Pose2 &oMr = poses[k];
    MountSample sample{oMr, {}};
    const double turned = plan.turn * std::min(static_cast<double>(k), 24.0) / 24.0;
    const Pose2 excess{0.0, 0.0, plan.slip * turned};
    const Pose2 pMo = (excess * oMr * rMp).inverse();
    for (std::size_t i = 0; i < landmarks.size(); ++i) {
      const Eigen::Vector2d seen = pMo * landmarks[i];
      double bearing = std::atan2(seen.y(), seen.x()) + random.normal(kNoise);
      if (random.uniform(0.0, 1.0) < plan.outliers) {
        bearing += random.uniform(-1.0, 1.0);
      }
      sample.bearings.push_back({static_cast<int>(i), wrapAngle(bearing)});
    }
    drive.push_back(sample);
  }
  return drive;
}

TEST(Mount, YawAndOffsetAreFoundWithTheirSigmas)
{
  double sum = 0.0;
  constexpr int kRuns = 40;
  for (int run = 0; run < kRuns; ++run) {
    Random random(9, static_cast<std::uint32_t>(run));
    const Pose2 truth{random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2),
                      random.uniform(-3.1, 3.1)};
    const MountEstimate found = calibrateMount(driven(truth, {}, static_cast<std::uint64_t>(run)));
    const Eigen::Vector3d off(found.rMp.x - truth.x, found.rMp.y - truth.y,
                              wrapAngle(found.rMp.heading - truth.heading));
    EXPECT_LT(std::abs(off[0]), 0.01);
    EXPECT_LT(std::abs(off[1]), 0.01);
    EXPECT_LT(std::abs(off[2]), radians(0.5));
    EXPECT_NEAR(found.rms, kNoise, 0.15 * kNoise);
    EXPECT_EQ(found.landmarks, kLandmarks);
    sum += off.dot(found.covariance.inverse() * off);
  }
  // Chi-square of three numbers: mean 3, variance 6.
  EXPECT_NEAR(sum / kRuns, 3.0, 4.0 * std::sqrt(6.0 / kRuns));
}

TEST(Mount, WrongBearingsDoLittleHarm)
{
  const Pose2 truth{0.1, -0.05, 1.2};
  Drive plan;
  plan.outliers = 0.1;
  const MountEstimate found = calibrateMount(driven(truth, plan, 3));
  EXPECT_NEAR(found.rMp.x, truth.x, 0.02);
  EXPECT_NEAR(found.rMp.y, truth.y, 0.02);
  EXPECT_NEAR(found.rMp.heading, truth.heading, radians(1.0));
}

TEST(Mount, TurnsThatOdometryMissesAreFound)
{
  const Pose2 truth{0.1, -0.05, 1.2};
  for (const double slip : {-0.08, 0.05}) {
    Drive plan;
    plan.slip = slip;
    const MountEstimate found = calibrateMount(driven(truth, plan, 4));
    EXPECT_NEAR(found.rMp.x, truth.x, 0.01);
    EXPECT_NEAR(found.rMp.y, truth.y, 0.01);
    EXPECT_NEAR(found.rMp.heading, truth.heading, radians(0.5));
  }
}

std::string refusal(const std::vector<MountSample> &drive)
{
  try {
    calibrateMount(drive);
  }
  catch (const ConfigError &error) {
    return error.what();
  }
  return "accepted";
}

TEST(Mount, SaysWhatWasNotDriven)
{
  const Pose2 truth{0.1, 0.0, 0.3};
  EXPECT_THAT(refusal(driven(truth, {.way = 0.1}, 1)), testing::HasSubstr("straight"));
  EXPECT_THAT(refusal(driven(truth, {.turn = 0.1}, 1)), testing::HasSubstr("turn of 90"));
  EXPECT_THAT(refusal({}), testing::HasSubstr("drove"));
  EXPECT_THAT(refusal(driven(truth, {.round = radians(120.0)}, 1)), testing::HasSubstr("one side"));
  auto drive = driven(truth, {}, 1);
  auto millimetres = drive;
  for (MountSample &sample : millimetres) {
    sample.oMr.x *= 1000.0;
    sample.oMr.y *= 1000.0;
  }
  EXPECT_THAT(refusal(millimetres), testing::HasSubstr("metres"));
  auto degreesForRadians = drive;
  for (MountSample &sample : degreesForRadians) {
    sample.oMr.heading = wrapAngle(degrees(sample.oMr.heading));
  }
  EXPECT_THAT(refusal(degreesForRadians), testing::Not(testing::HasSubstr("accepted")));
  auto shortLived = drive; // each is lost after four sights
  for (std::size_t k = 0; k < shortLived.size(); ++k) {
    for (LandmarkBearing &seen : shortLived[k].bearings) {
      seen.landmark += 1000 * static_cast<int>(k / 4);
    }
  }
  EXPECT_THAT(refusal(shortLived), testing::HasSubstr("landmarks are lost again after 4.00 of 40"));
  for (MountSample &sample : drive) {
    sample.bearings.resize(2);
  }
  EXPECT_THAT(refusal(drive), testing::HasSubstr("2 landmarks"));
}

} // namespace
} // namespace homeward
