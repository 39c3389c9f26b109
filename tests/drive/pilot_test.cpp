// SPDX-License-Identifier: GPL-3.0-or-later
#include "test_paths.h"
#include "test_robot.h"

#include <homeward/core/error.h>
#include <homeward/pilot/pilot.h>
#include <homeward/sim/simulator.h>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace homeward
{
namespace
{

/** Shows what the camera sees, or nothing but black, or half of it over-exposed or black. */
class CoveredCamera : public ImageSource
{
public:
  explicit CoveredCamera(ImageSource &camera) : m_camera(camera) {}

  std::optional<Frame> grab() override
  {
    std::optional<Frame> frame = m_camera.grab();
    if (frame && covered) {
      frame->image = cv::Mat::zeros(frame->image.size(), frame->image.type());
    }
    if (frame && damage) {
      frame->image = frame->image.clone();
      damage(frame->image);
    }
    return frame;
  }

  bool covered = false;
  std::function<void(cv::Mat &)> damage;

private:
  ImageSource &m_camera;
};

/** A pilot in the laboratory, or in another world. */
class PilotTest : public testing::Test
{
protected:
  explicit PilotTest(const RobotDescription &robot = testRobot(), const PilotOptions &options = {},
                     const std::string &world = "worlds/lab.sdf", const Pose2 &start = {0, -2.5, 0},
                     const SimulatorOptions &simulation = {})
      : m_scene(std::make_shared<const Scene>(loadScene(dataDir() / world))),
        simulator(m_scene, robot, testCamera(), optionsAt(start, simulation)),
        camera(simulator.camera()),
        pilot({simulator.clock(), simulator.base(), simulator.laser(), camera}, robot, testCamera(),
              options, stop)
  {}

  template <class Answer> Answer ask(const Command &command)
  {
    return std::get<Answer>(pilot.execute(command));
  }

  /** Surveys and makes the place known. */
  Surveyed makeNode(NodeId node)
  {
    auto surveyed = ask<Surveyed>(Survey{});
    pilot.remember(node, pilot.view());
    return surveyed;
  }

  /** Drives off from a new node and back to stand exactly there. @return where that was */
  Pose2 comeBackExactly()
  {
    const Pose2 home = simulator.truth().pose;
    makeNode(NodeId{0});
    ask<Driven>(DriveDirection{0.4, 1.5});
    EXPECT_EQ(ask<Homed>(HomeTo{NodeId{0}, std::nullopt, true}).end, HomingEnd::Arrived);
    EXPECT_NEAR(wrapAngle(simulator.truth().pose.heading - home.heading), 0.0, radians(1.5));
    return home;
  }

  double distanceTo(const Pose2 &place) const
  {
    return (simulator.truth().pose.translation() - place.translation()).norm();
  }

private:
  static SimulatorOptions optionsAt(const Pose2 &start, SimulatorOptions options)
  {
    options.start = start;
    return options;
  }

  std::shared_ptr<const Scene> m_scene;

protected:
  Simulator simulator;
  CoveredCamera camera;
  std::atomic<bool> stop = false;
  Pilot pilot;
};

/** Its mirror stands ahead of its middle and is turned to the left. */
class AskewPilotTest : public PilotTest
{
protected:
  AskewPilotTest() : PilotTest(askew()) {}

private:
  static RobotDescription askew()
  {
    RobotDescription robot = testRobot();
    robot.rMp.translation().x() += 0.2;
    robot.rMp.rotate(Eigen::AngleAxisd(radians(30.0), Eigen::Vector3d::UnitZ()));
    return robot;
  }
};

/** Has no time to settle by sight: steps by odometry do the rest. */
class SteppingPilotTest : public PilotTest
{
protected:
  SteppingPilotTest() : PilotTest(testRobot(), stepping()) {}

private:
  static PilotOptions stepping()
  {
    PilotOptions options;
    options.homing.settleSeconds = 0.0;
    return options;
  }
};

/** What a pilot sees whose camera file is so many pixels off, from one place in the laboratory. */
cv::Mat panoramaOfCameraOff(const Eigen::Vector2d &pixels, bool withRim)
{
  const auto scene = std::make_shared<const Scene>(loadScene(dataDir() / "worlds/lab.sdf"));
  SimulatorOptions options;
  options.start = Pose2{0.0, -2.5, 0.0};
  Simulator simulator(scene, testRobot(), testCamera(), options);
  MirrorCamera file = testCamera();
  UnifiedCamera::Parameters parameters = file.model.parameters();
  parameters.cx += pixels.x();
  parameters.cy += pixels.y();
  file.model = UnifiedCamera(parameters, 640, 480);
  if (withRim) {
    file.rim = MirrorRim{{parameters.cx, parameters.cy}, 236.0};
  }
  const std::atomic<bool> stop = false;
  Pilot pilot({simulator.clock(), simulator.base(), simulator.laser(), simulator.camera()},
              testRobot(), file, {}, stop);
  pilot.execute(Survey{});
  return pilot.view().image;
}

TEST(PilotCamera, IsFollowedWhenItHasShiftedUnderItsMirror)
{
  const cv::Mat right = panoramaOfCameraOff({0.0, 0.0}, true);
  const auto difference = [&](const cv::Mat &panorama) {
    return cv::norm(right, panorama, cv::NORM_L1) / static_cast<double>(right.total());
  };
  const double followed = difference(panoramaOfCameraOff({4.0, -3.0}, true));
  const double notFollowed = difference(panoramaOfCameraOff({4.0, -3.0}, false));
  EXPECT_LT(followed, 0.25 * notFollowed);
}

TEST_F(PilotTest, DrivesOffAndFindsBackBySight)
{
  const Pose2 home = simulator.truth().pose;
  const Surveyed survey = makeNode(NodeId{0});
  EXPECT_FALSE(survey.directions.empty());
  const auto driven = ask<Driven>(DriveDirection{0.4, 1.5});
  EXPECT_FALSE(driven.blocked);
  EXPECT_NEAR(distanceTo(home), 1.5, 0.25);
  EXPECT_NEAR(driven.chord.distance, 1.5, 0.25);

  const auto homed = ask<Homed>(HomeTo{NodeId{0}, std::nullopt});
  EXPECT_EQ(homed.end, HomingEnd::Arrived);
  EXPECT_LT(distanceTo(home), 0.25);
  EXPECT_EQ(simulator.truth().collisions, 0);
}

TEST_F(PilotTest, StandsExactlyWhereItStoodAndAsItStoodWhenAskedTo)
{
  EXPECT_LT(distanceTo(comeBackExactly()), 0.08);
  EXPECT_NEAR(simulator.base().state().velocity.v, 0.0, 0.02);
  EXPECT_EQ(simulator.truth().collisions, 0);
}

TEST_F(AskewPilotTest, StandsWhereTheRobotStoodAndNotItsMirror)
{
  EXPECT_LT(distanceTo(comeBackExactly()), 0.1);
}

TEST_F(SteppingPilotTest, StepsOverWhatIsLeftWhenItStands)
{
  EXPECT_LT(distanceTo(comeBackExactly()), 0.08);
}

/** Its sonars look all round. */
class AllRoundPilotTest : public PilotTest
{
protected:
  AllRoundPilotTest() : PilotTest(allRound()) {}

  static RobotDescription allRound()
  {
    RobotDescription robot = testRobot();
    for (std::size_t i = 0; i < 8; ++i) {
      const SonarMount &front = robot.sonars[i];
      robot.sonars.push_back({-front.x, front.y, front.z, wrapAngle(kPi - front.bearing)});
    }
    return robot;
  }

  /** Home from where its nose is at a cabinet: no room to turn, no way that it has come. */
  HomingEnd homeFromACabinet()
  {
    simulator.kidnap(home);
    ask<Surveyed>(Survey{});
    const Panorama view = pilot.view();
    simulator.kidnap({2.704, -3.465, -0.974});
    Pilot fresh({simulator.clock(), simulator.base(), simulator.laser(), camera}, allRound(),
                testCamera(), {}, stop);
    fresh.remember(NodeId{0}, view);
    return std::get<Homed>(fresh.execute(HomeTo{NodeId{0}, std::nullopt})).end;
  }

  const Pose2 home{4.816, -2.441, 0.370};
};

TEST_F(AllRoundPilotTest, BacksOutOfWhereItWasPut)
{
  EXPECT_EQ(homeFromACabinet(), HomingEnd::Arrived);
  EXPECT_LT(distanceTo(home), 0.3);
  EXPECT_EQ(simulator.truth().collisions, 0);
}

/** In a loop of corridors with equal doors. */
class CorridorPilotTest : public PilotTest
{
protected:
  CorridorPilotTest() : PilotTest(testRobot(), {}, "worlds/corridors.sdf", kHome)
  {
    makeNode(NodeId{0});
  }

  HomingEnd homeFrom(const Pose2 &place, bool surely)
  {
    simulator.kidnap(place);
    return ask<Homed>(HomeTo{NodeId{0}, std::nullopt, false, surely}).end;
  }

  static constexpr Pose2 kHome{-4.373, -0.378, -3.102};
  static constexpr Pose2 kAlike{4.19, -11.02, -0.13}; ///< beside a place in the corridor opposite
};

TEST_F(CorridorPilotTest, DoesNotTakeAPlaceThatLooksAlikeForTheOneItMakesSureOf)
{
  EXPECT_EQ(homeFrom(kAlike, false), HomingEnd::Arrived);
  EXPECT_GT(distanceTo(kHome), 5.0);
  EXPECT_EQ(homeFrom(kAlike, true), HomingEnd::Lost);
  const Pose2 beside{kHome.x - 0.8, kHome.y - 0.3, 0.5};
  EXPECT_EQ(homeFrom(beside, true), HomingEnd::Arrived);
  EXPECT_LT(distanceTo(kHome), 0.3);
}

/** Its turns skid much. */
class SkiddingPilotTest : public PilotTest
{
protected:
  SkiddingPilotTest()
      : PilotTest(testRobot(), {}, "worlds/lab.sdf", {0, -2.5, 0},
                  {.seed = 5, .drive = {.turnSlip = 0.06}})
  {}

  /** How wrong the chord has the turn after a drive that the camera did not see. */
  double errorOfABlindTurn()
  {
    const Pose2 home = simulator.truth().pose;
    makeNode(NodeId{m_next++});
    camera.covered = true;
    const auto driven = ask<Driven>(DriveDirection{-2.8, 0.8});
    camera.covered = false;
    const Pose2 there = home.inverse() * simulator.truth().pose;
    return std::abs(wrapAngle(driven.chord.bearingAtOrigin - std::atan2(there.y, there.x)));
  }

  std::int64_t m_next = 0;
};

TEST_F(SkiddingPilotTest, LearnsHowMuchFromWhatItSeesOfPlacesLeft)
{
  const double untaught = errorOfABlindTurn();
  for (const double bearing : {-2.5, 2.6, -2.9, 2.8}) {
    makeNode(NodeId{m_next++});
    ask<Driven>(DriveDirection{bearing, 0.8});
  }
  EXPECT_LT(errorOfABlindTurn(), 0.5 * untaught) << degrees(untaught) << " degrees at first";
  EXPECT_GT(untaught, radians(8.0)) << "or there was little to learn";
}

TEST_F(PilotTest, ArrivesByTheBoundAskedForAndGivesUpWhenItsPatienceEnds)
{
  const Pose2 home = simulator.truth().pose;
  makeNode(NodeId{0});
  ask<Driven>(DriveDirection{0.4, 1.0});
  const Pose2 away = simulator.truth().pose;
  PilotOptions options;
  options.homing.closeProxy = 2.0; // everywhere, to tell the two bounds apart
  options.homing.timeoutOnWay = 1.0;
  Pilot other({simulator.clock(), simulator.base(), simulator.laser(), simulator.camera()},
              testRobot(), testCamera(), options, stop);
  other.remember(NodeId{0}, pilot.view());
  HomeTo command{NodeId{0}, std::nullopt};
  const auto end = [&] {
    simulator.kidnap(away);
    return std::get<Homed>(other.execute(command)).end;
  };
  EXPECT_EQ(end(), HomingEnd::Arrived);
  EXPECT_LT(distanceTo(home), 0.3);
  command.closely = true;
  EXPECT_EQ(end(), HomingEnd::Arrived);
  EXPECT_GT(distanceTo(home), 0.6);
  command.closely = false;
  command.patience = 1.0;
  EXPECT_EQ(end(), HomingEnd::TimedOut);
  command.patience.reset();
  command.way = Way{0.0, 1.0};
  command.direct = true;
  EXPECT_EQ(end(), HomingEnd::TimedOut);
}

TEST_F(PilotTest, KnowsThePlaceAgainAndNoOther)
{
  makeNode(NodeId{0});
  const auto here = ask<Recognised>(Recognise{});
  ASSERT_EQ(here.matches.size(), 1U);
  EXPECT_TRUE(here.matches[0].verified);
  ask<Driven>(DriveDirection{0.4, 2.0});
  EXPECT_FALSE(ask<Recognised>(Recognise{}).matches[0].verified);
}

TEST_F(PilotTest, TheChordTellsTheTurnThatTheWheelsForget)
{
  const Pose2 home = simulator.truth().pose;
  makeNode(NodeId{0});
  const auto driven = ask<Driven>(DriveDirection{2.6, 1.5});
  const Pose2 there = home.inverse() * simulator.truth().pose;
  EXPECT_NEAR(wrapAngle(driven.chord.bearingAtOrigin - std::atan2(there.y, there.x)), 0.0,
              radians(3.0));
  const Pose2 back = simulator.truth().pose.inverse() * home;
  EXPECT_NEAR(wrapAngle(driven.chord.bearingAtHere - std::atan2(back.y, back.x)), 0.0,
              radians(3.0));
}

TEST_F(PilotTest, IsLostAndStandsWhenTheCameraIsCovered)
{
  makeNode(NodeId{0});
  ask<Driven>(DriveDirection{0.4, 1.5});
  camera.covered = true;
  const Pose2 before = simulator.truth().pose;
  EXPECT_EQ(ask<Homed>(HomeTo{NodeId{0}, std::nullopt}).end, HomingEnd::Lost);
  EXPECT_LT(distanceTo(before), 0.05);
  EXPECT_NEAR(simulator.base().state().velocity.v, 0.0, 0.02);
}

TEST_F(PilotTest, HomesOrStandsWhenTheCameraIsDamaged)
{
  const Pose2 home = simulator.truth().pose;
  makeNode(NodeId{0});
  ask<Driven>(DriveDirection{0.4, 1.5});
  const Pose2 before = simulator.truth().pose;
  const std::vector<std::function<void(cv::Mat &)>> damages{
      [](cv::Mat &image) { image.colRange(0, image.cols / 2).setTo(0); },
      [](cv::Mat &image) { image = image * 6.0; },
      [](cv::Mat &image) { cv::randu(image, cv::Scalar::all(0), cv::Scalar::all(256)); }};
  for (const auto &damage : damages) {
    simulator.kidnap(before);
    camera.damage = damage;
    const HomingEnd end = ask<Homed>(HomeTo{NodeId{0}, std::nullopt}).end;
    EXPECT_LT(end == HomingEnd::Arrived ? distanceTo(home) : 0.0, 0.4);
    std::printf("%s %.2f from home %.2f from start\n", name(end), distanceTo(home),
                distanceTo(before));
    EXPECT_NEAR(simulator.base().state().velocity.v, 0.0, 0.02);
  }
}

TEST_F(PilotTest, SaysHowFarItSeesPastWhatBlocksADrive)
{
  const Surveyed surveyed = makeNode(NodeId{0});
  const auto free = ask<Driven>(DriveDirection{surveyed.directions[0].bearing, 0.5});
  EXPECT_FALSE(free.blocked);
  EXPECT_TRUE(std::isinf(free.seenAhead));
  ask<Homed>(HomeTo{NodeId{0}, std::nullopt});
  const auto wall = ask<Driven>(DriveDirection{surveyed.directions[0].bearing, 20.0});
  EXPECT_TRUE(wall.blocked);
  EXPECT_GT(wall.seenAhead, 0.2);
  EXPECT_LT(wall.seenAhead, 1.2);
}

TEST_F(PilotTest, AStopInterruptsADrive)
{
  makeNode(NodeId{0});
  stop = true;
  EXPECT_TRUE(std::holds_alternative<Interrupted>(pilot.execute(DriveDirection{0.4, 1.5})));
}

TEST_F(PilotTest, RefusesAPlaceThatItNeverSaw)
{
  EXPECT_THROW(pilot.execute(HomeTo{NodeId{7}, std::nullopt}), LogicError);
}

} // namespace
} // namespace homeward
