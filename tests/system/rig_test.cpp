// SPDX-License-Identifier: GPL-3.0-or-later
#include "rig_check.h"
#include "rig_fixture.h"

#include <homeward/calib/bearing_tracks.h>
#include <homeward/calib/mount.h>
#include <homeward/core/angle.h>
#include <homeward/core/error.h>
#include <homeward/dataset/data_set.h>

#include <gmock/gmock.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <thread>

namespace homeward
{
namespace
{

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST_F(RigTest, CheckSaysHowEveryDeviceIsAndMovesNothing)
{
  const ProgramRun run = runProgram("rig check " + rigFile());
  EXPECT_EQ(run.status, 0) << run.output;
  EXPECT_THAT(run.output,
              AllOf(HasSubstr("base   ok"), HasSubstr("laser  ok"), HasSubstr("camera ok"),
                    HasSubstr("640 x 480"), HasSubstr("pioneer-sim"), Not(HasSubstr("motion"))));
}

TEST_F(RigTest, CheckSaysWhoseUnitsAreUsed)
{
  EXPECT_THAT(runProgram("rig check " + rigFile()).output,
              HasSubstr("units known of a 'p3at': 0.465 mm"));
  const std::string units = "Subclass mine\nDistConvFactor 0.5\nAngleConvFactor 0.001534\n"
                            "VelConvFactor 1\nRangeConvFactor 1\nDiffConvFactor 0.0034\n";
  std::ofstream(folder / "mine.p") << units;
  base = "parameters: mine.p";
  const ProgramRun other = runProgram("rig check " + rigFile());
  EXPECT_EQ(other.status, 1) << other.output;
  EXPECT_THAT(other.output, AllOf(HasSubstr("units of mine.p: 0.500 mm"),
                                  HasSubstr("for a 'mine', the robot is")));
  std::ofstream(folder / "mine.p") << "Subclass p3at\n" << units.substr(units.find('D'));
  const ProgramRun same = runProgram("rig check " + rigFile());
  EXPECT_EQ(same.status, 0) << same.output;
  EXPECT_THAT(same.output, HasSubstr("ok: units of mine.p: 0.500 mm"));
  base = "parameters: nowhere.p";
  const ProgramRun missing = runProgram("rig check " + rigFile());
  EXPECT_EQ(missing.status, 2) << missing.output;
  EXPECT_THAT(missing.output, HasSubstr("nowhere.p"));
}

TEST_F(RigTest, CheckSaysWhatIsPressedAndWhereSpeedMeansNothing)
{
  address = sim.arcosPty();
  fault("estop", true);
  fault("front", true);
  const ProgramRun run = runProgram("rig check " + rigFile());
  EXPECT_EQ(run.status, 1) << run.output;
  EXPECT_THAT(run.output, AllOf(HasSubstr("base   BAD"), HasSubstr("motors stay off"),
                                HasSubstr("front bumper"), HasSubstr("any speed is right")));
}

TEST_F(RigTest, CheckMovesOnlyWhenTheOperatorSaysYes)
{
  const ProgramRun no = runProgram("rig check --move " + rigFile(), "echo no | ");
  EXPECT_EQ(no.status, 1) << no.output;
  EXPECT_THAT(no.output, HasSubstr("has not moved"));
  const ProgramRun yes = runProgram("rig check --move " + rigFile(), "echo yes | ");
  EXPECT_EQ(yes.status, 0) << yes.output;
  EXPECT_THAT(yes.output, AllOf(HasSubstr("turn: laser"), HasSubstr("turn: camera"),
                                HasSubstr("advance: laser"), Not(HasSubstr("BAD"))));
}

TEST_F(RigTest, CheckFindsACameraMountedTheOtherWayRound)
{
  std::string camera = fileText((dataDir() / "cameras/sim_nominal.yaml").string());
  const std::string right = "left_is_clockwise: true";
  camera.replace(camera.find(right), right.size(), "left_is_clockwise: false");
  std::ofstream(folder / "camera.yaml") << camera;
  const ProgramRun run =
      runProgram("rig check --move " + rigFile(folder / "camera.yaml"), "echo yes | ");
  EXPECT_EQ(run.status, 1) << run.output;
  EXPECT_THAT(run.output, HasSubstr("left and right exchanged"));
}

TEST_F(RigTest, ExploresOverSockets)
{
  const ProgramRun run =
      runProgram("explore --rig " + rigFile() + " --truth " + truthUrl() + " --max-time 40 --map " +
                 folder / "room.hwm" + " --json " + folder / "room.json");
  EXPECT_EQ(run.status, 1) << run.output; // stopped by --max-time
  const auto json = nlohmann::json::parse(fileText(folder / "room.json"));
  EXPECT_EQ(json["outcome"], "stopped");
  EXPECT_GE(json["nodes"], 2);
  EXPECT_EQ(json["collisions"], 0);
  EXPECT_EQ(json["truth"]["false_edges"], 0);
  const ProgramRun drive =
      runProgram("navigate --rig " + rigFile() + " --truth " + truthUrl() + " --to 0 --map " +
                 folder / "room.hwm" + " --json " + folder / "drive.json");
  EXPECT_EQ(drive.status, 0) << drive.output;
  const auto driven = nlohmann::json::parse(fileText(folder / "drive.json"));
  // A bare room with one post: places are hard to tell apart.
  EXPECT_LE(driven["truth"]["error_m"].get<double>(), 1.0);
}

TEST_F(RigTest, ARobotThatDiesEndsTheMissionWithItsReasonAndAMap)
{
  const std::string map = folder / "room.hwm";
  std::thread killer([this, &map] {
    for (int i = 0; i < 600 && !std::filesystem::exists(map); ++i) {
      ::usleep(100'000);
    }
    ::sleep(2);
    sim.end(SIGKILL);
  });
  const ProgramRun run = runProgram("explore --rig " + rigFile() + " --map " + map);
  killer.join();
  EXPECT_EQ(run.status, 1) << run.output;
  EXPECT_THAT(run.output, testing::ContainsRegex("homeward: [^\n]*\n$"));
}

TEST_F(RigTest, WhatCannotBeIsRefusedInOneLine)
{
  const std::string explore = "explore --map " + folder / "x.hwm" + " ";
  const auto refusal = [](const std::string &arguments) {
    const ProgramRun run = runProgram(arguments);
    EXPECT_GT(run.status, 0) << run.output;
    EXPECT_EQ(std::count(run.output.begin(), run.output.end(), '\n'), 1) << run.output;
    return run.output;
  };
  EXPECT_THAT(refusal(explore + "--rig " + rigFile() + " --world lab.sdf"), HasSubstr("--world"));
  EXPECT_THAT(refusal(explore + "--clock-rate 2"), HasSubstr("real devices"));
  EXPECT_THAT(refusal(explore + "--rig " + rigFile() + " --truth http://127.0.0.1:1"),
              HasSubstr("127.0.0.1:1"));
  EXPECT_THAT(refusal("rig check nowhere.yaml"), HasSubstr("nowhere.yaml"));
  EXPECT_THAT(refusal("rig check " + (dataDir() / "rigs/sim.yaml").string()),
              HasSubstr("names no devices"));
  const std::string rig = rigFile();
  sim.end(SIGTERM);
  EXPECT_THAT(refusal("rig check " + rig), HasSubstr("camera.mjpg"));
}

/** Ranges of a room with a step on the left, from a laser turned left by so many degrees. */
Scan turnedBy(int turn)
{
  Scan scan;
  scan.angleMin = -kPi / 2.0;
  scan.angleStep = radians(1.0);
  scan.rangeMax = 30.0;
  for (int i = 0; i <= 180; ++i) {
    const int bearing = i - 90 + turn;
    scan.ranges.push_back(
        bearing > 20 && bearing < 50 ? 2.0F : 5.0F + 0.01F * static_cast<float>(bearing));
  }
  return scan;
}

TEST(TurnBetween, FindsTheTurnOfALaser)
{
  for (const int turn : {-40, -7, 0, 15, 33}) {
    EXPECT_NEAR(turnBetween(turnedBy(0), turnedBy(turn)), radians(turn), 1e-9) << turn;
  }
}

MotionSeen asItShould()
{
  return {radians(31.0), radians(30.0), radians(31.5), 0.15, 0.16};
}

TEST(JudgeMotion, FindsWhatIsMountedTheWrongWayRound)
{
  const auto complaints = [](const MotionSeen &seen) {
    std::string all;
    for (const Finding &finding : judgeMotion(seen)) {
      all += finding.good ? "" : finding.text + "\n";
    }
    return all;
  };
  EXPECT_EQ(complaints(asItShould()), "");
  MotionSeen seen = asItShould();
  seen.laserTurn *= -1.0;
  EXPECT_THAT(complaints(seen), HasSubstr("upside down"));
  seen = asItShould();
  seen.cameraTurn *= -1.0;
  EXPECT_THAT(complaints(seen), HasSubstr("left_is_clockwise"));
  seen = asItShould();
  seen.odometryAdvance = 0.3;
  EXPECT_THAT(complaints(seen), HasSubstr("scale"));
  seen = asItShould();
  seen.laserAdvance *= -1.0;
  EXPECT_THAT(complaints(seen), HasSubstr("wrong way round"));
  seen = asItShould();
  seen.odometryTurn = 0.0;
  EXPECT_THAT(complaints(seen), HasSubstr("odometry says 0"));
  seen = asItShould();
  seen.cameraTurn = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(complaints(seen), "");
}

MountEstimate mountFrom(const DataSet &set)
{
  std::vector<DriveView> views;
  for (std::size_t i = 0; i < set.size(); ++i) {
    views.push_back({set.view(i).pose, set.panorama(i)});
  }
  return calibrateMount(trackBearings(views, set.visible()));
}

TEST_F(RigTest, DriveGoesOnceRoundAndStraightWhenTold)
{
  const std::string drive = folder / "drive";
  EXPECT_EQ(runProgram("rig drive " + drive + " --rig " + rigFile(), "echo no | ").status, 1);
  EXPECT_FALSE(std::filesystem::exists(drive));
  const ProgramRun run = runProgram("rig drive " + drive + " --rig " + rigFile(), "echo yes | ");
  ASSERT_EQ(run.status, 0) << run.output;
  const DataSet set = DataSet::read(drive);
  ASSERT_GT(set.size(), 40U);
  double most = 0.0;
  for (std::size_t i = 1; i < set.size(); ++i) {
    const Pose2 step = set.view(i - 1).pose.inverse() * set.view(i).pose;
    most = std::max(most, std::abs(step.heading));
  }
  EXPECT_LT(most, radians(20.0));
  const Pose2 whole = set.view(0).pose.inverse() * set.view(set.size() - 1).pose;
  EXPECT_GT(whole.translation().norm(), 0.6);
  // There is next to nothing to see in that room: an estimate knows that, or is refused.
  try {
    const MountEstimate mount = mountFrom(set);
    const double tilt = radians(1.0); // the mirror's own, which no sigma knows
    EXPECT_LT(std::abs(mount.rMp.heading), 3.0 * std::sqrt(mount.covariance(2, 2)) + tilt)
        << mount.landmarks << " landmarks, rms " << mount.rms;
  }
  catch (const ConfigError &refusal) {
    EXPECT_THAT(refusal.what(), testing::AnyOf(HasSubstr("yaw"), HasSubstr("landmarks")));
  }
  EXPECT_EQ(runProgram("rig drive " + drive + " --rig " + rigFile(), "echo yes | ").status, 2);
}

TEST(RigDrive, TellsWhereTheCameraSits)
{
  const Folder folder;
  const std::string drive = folder / "drive";
  const ProgramRun run =
      runProgram("rig drive " + drive + " --world " + (dataDir() / "worlds/lab.sdf").string());
  ASSERT_EQ(run.status, 0) << run.output;
  const MountEstimate mount = mountFrom(DataSet::read(drive));
  EXPECT_NEAR(mount.rMp.x, 0.0, 0.01);
  EXPECT_NEAR(mount.rMp.y, 0.0, 0.01);
  EXPECT_NEAR(mount.rMp.heading, 0.0, radians(1.0)); // its odometry misses the turns by 3 %
}

} // namespace
} // namespace homeward
