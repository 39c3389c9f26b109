// SPDX-License-Identifier: GPL-3.0-or-later
// What a drive home does with home vectors that are as good or as bad as a test wants them.
#include "../contract/test_room.h"
#include "test_robot.h"

#include <homeward/core/random.h>
#include <homeward/pilot/homing_run.h>
#include <homeward/sim/simulator.h>

#include <gtest/gtest.h>

namespace homeward
{
namespace
{

/** Notes where each picture was taken: home vectors are made later, while the robot drives on. */
class NotedCamera final : public ImageSource
{
public:
  explicit NotedCamera(Simulator &simulator) : m_simulator(simulator) {}

  std::optional<Frame> grab() override
  {
    taken = m_simulator.truth().pose;
    return m_simulator.camera().grab();
  }

  Pose2 taken;

private:
  Simulator &m_simulator;
};

/** A robot that drives home by home vectors made from the truth. */
class Homer
{
public:
  /** What a test makes of a home vector, given how many metres it is to home. */
  using Spoil = std::function<void(HomeVector &home, double metres)>;

  Homer(Scene scene, const Pose2 &start)
      : m_simulator(share(std::move(scene)), testRobot(), testCamera(), optionsAt(start)),
        m_camera(m_simulator),
        m_motion({m_simulator.clock(), m_simulator.base(), m_simulator.laser(), m_camera},
                 testRobot(), {}, m_stop)
  {}

  HomingEnd driveTo(const Pose2 &home, const Spoil &spoil)
  {
    HomingServo servo(Eigen::Isometry3d::Identity());
    const double landmarks = servo.options().landmarkRange;
    HomingRun run(m_motion, servo, {}, [&](const cv::Mat & /*picture*/) {
      const Pose2 here = m_camera.taken;
      const Eigen::Vector2d way = here.inverse() * home.translation();
      HomeVector seen{std::atan2(way.y(), way.x()), std::max(0.005, way.norm() / landmarks),
                      wrapAngle(here.heading - home.heading), 0.8};
      spoil(seen, way.norm());
      return std::optional(seen);
    });
    return run.run(std::nullopt).end;
  }

  double distanceTo(const Pose2 &place) const
  {
    return (m_simulator.truth().pose.translation() - place.translation()).norm();
  }

  int collisions() const { return m_simulator.truth().collisions; }

private:
  static SimulatorOptions optionsAt(const Pose2 &start)
  {
    SimulatorOptions options;
    options.start = start;
    return options;
  }

  Simulator m_simulator;
  NotedCamera m_camera;
  std::atomic<bool> m_stop = false;
  Motion m_motion;
};

constexpr double kUnsure = 0.03;
const Pose2 kHome{4.0, 2.5, 0.3};
const Pose2 kAway{2.0, 2.0, -1.0};

TEST(HomingRun, goesWhereUnsureHomeVectorsAgree)
{
  Homer robot(makeRoom(6.0F, 5.0F), kAway);
  const HomingEnd end = robot.driveTo(kHome, [](HomeVector &home, double metres) {
    home.confidence = metres > 1.2 ? kUnsure : home.confidence;
  });
  EXPECT_EQ(end, HomingEnd::Arrived);
  EXPECT_LT(robot.distanceTo(kHome), 0.3);
}

TEST(HomingRun, staysWhereUnsureHomeVectorsDoNotAgree)
{
  Homer robot(makeRoom(6.0F, 5.0F), kAway);
  Random random(3, 0);
  const HomingEnd end = robot.driveTo(kHome, [&](HomeVector &home, double /*metres*/) {
    home.confidence = kUnsure;
    home.direction = random.uniform(-kPi, kPi);
  });
  EXPECT_EQ(end, HomingEnd::Lost);
  EXPECT_LT(robot.distanceTo(kAway), 0.05);
}

TEST(HomingRun, givesUpWhereUnsureHomeVectorsLeadNowhere)
{
  Homer robot(makeRoom(12.0F, 5.0F), kAway);
  const HomingEnd end = robot.driveTo(
      {11.0, 2.5, 0.0}, [](HomeVector &home, double /*metres*/) { home.confidence = kUnsure; });
  EXPECT_EQ(end, HomingEnd::Lost);
  EXPECT_GT(robot.distanceTo(kAway), 1.0);
  EXPECT_LT(robot.distanceTo(kAway), 2.2);
}

TEST(HomingRun, goesOnAheadOutOfAGapWithHomeBesideIt)
{
  Scene scene = makeRoom(6.0F, 5.0F);
  addBox(scene, {1.5F, 2.45F, 0.0F}, {2.6F, 2.6F, 1.0F});
  addBox(scene, {1.5F, 1.4F, 0.0F}, {2.6F, 1.55F, 1.0F});
  const Pose2 home{1.9, 4.0, 0.0};
  Homer robot(std::move(scene), {2.2, 2.0, 0.0});
  EXPECT_EQ(robot.driveTo(home, [](HomeVector &, double) {}), HomingEnd::Arrived);
  EXPECT_LT(robot.distanceTo(home), 0.3);
  EXPECT_EQ(robot.collisions(), 0);
}

TEST(HomingRun, knowsAPlaceItCannotGetNearerToByTheScaleOfTheWay)
{
  // Home is nearer to the wall than the robot can stand.
  const Pose2 home{5.82, 2.5, 0.0};
  for (const double factor : {1.0, 3.0}) {
    Homer robot(makeRoom(6.0F, 5.0F), {3.0, 1.4, 0.0});
    const HomingEnd end = robot.driveTo(
        home, [&](HomeVector &seen, double /*metres*/) { seen.distanceProxy *= factor; });
    EXPECT_EQ(end, HomingEnd::Arrived) << factor;
    EXPECT_LT(robot.distanceTo(home), 0.35) << factor;
    EXPECT_EQ(robot.collisions(), 0);
  }
}

} // namespace
} // namespace homeward
