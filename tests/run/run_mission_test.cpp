// SPDX-License-Identifier: GPL-3.0-or-later
#include "../contract/test_room.h"
#include "folder.h"
#include "test_robot.h"

#include <homeward/run/run_mission.h>
#include <homeward/sim/simulator.h>

#include <gmock/gmock.h>

namespace homeward
{
namespace
{

/** Surveys, makes a node of it, looks whether it is recognised, and ends. */
struct OneNode
{
  struct State
  {
    bool recognised = false;
  };

  static Step<State> start(const TopologicalMap & /*map*/) { return {{}, Survey{}, {}, {}}; }

  static Step<State> next(const State & /*state*/, const TopologicalMap &map, const Report &report)
  {
    if (std::holds_alternative<Surveyed>(report)) {
      return {{}, Recognise{}, {NodeAdded{{map.nextNodeId()}}}, {"a node"}};
    }
    const auto *recognised = std::get_if<Recognised>(&report);
    const bool known = recognised != nullptr && !recognised->matches.empty();
    return {{known},
            Finish{recognised != nullptr ? Outcome::Done : Outcome::Stopped, "seen"},
            {},
            {"the end"}};
  }
};

class RunMission : public testing::Test
{
protected:
  Finish run(bool enough)
  {
    return runMission(
        OneNode(), OneNode::start(file.map()), pilot, file.map(), &file, simulator.clock(), counts,
        [=] { return enough; },
        [this](const Step<OneNode::State> &step) {
          nodesInFile.push_back(file.map().nodes().size());
          recognised = step.state.recognised;
        });
  }

  static SimulatorOptions start()
  {
    SimulatorOptions options;
    options.start = Pose2{2.0, 2.0, 0.0};
    return options;
  }

  Folder folder;
  Simulator simulator{share(makeRoom(5.0F, 4.0F)), testRobot(), testCamera(), start()};
  std::atomic<bool> stop = false;
  RobotDescription robot = testRobot();
  MirrorCamera camera = testCamera();
  Pilot pilot{{simulator.clock(), simulator.base(), simulator.laser(), simulator.camera()},
              robot,
              camera,
              PilotOptions(),
              stop};
  MapFile file = MapFile::create(folder / "map.hwm", {"", PilotOptions().panorama, "sad", 1, {}});
  MissionCounts counts;
  std::vector<std::size_t> nodesInFile; ///< at each step
  bool recognised = false;
};

TEST_F(RunMission, aStepIsInTheFileAndKnownBySightBeforeItsCommandIsGiven)
{
  EXPECT_EQ(run(false).outcome, Outcome::Done);
  EXPECT_EQ(nodesInFile, (std::vector<std::size_t>{0, 1, 1}));
  EXPECT_TRUE(recognised) << "the pilot knew the new node";
  EXPECT_TRUE(file.hasView(NodeId{0}));
  const std::vector<LogLine> log = file.log();
  ASSERT_EQ(log.size(), 2U);
  EXPECT_EQ(log.front().text, "a node");
  EXPECT_EQ(log.back().text, "the end");
  EXPECT_LE(log.front().time, log.back().time);
}

TEST_F(RunMission, enoughIsAnInterruption)
{
  EXPECT_EQ(run(true).outcome, Outcome::Stopped);
  EXPECT_EQ(file.map().nodes().size(), 0U);
}

TEST_F(RunMission, whatAMapHoldsIsRememberedByANewPilot)
{
  run(false);
  Pilot other({simulator.clock(), simulator.base(), simulator.laser(), simulator.camera()}, robot,
              camera, PilotOptions(), stop);
  EXPECT_TRUE(std::get<Recognised>(other.execute(Recognise{})).matches.empty());
  rememberAll(file, other);
  const auto report = std::get<Recognised>(other.execute(Recognise{}));
  ASSERT_FALSE(report.matches.empty());
  EXPECT_EQ(report.matches.front().node, NodeId{0});
}

TEST(MissionCounts, onlyHomingsCount)
{
  MissionCounts counts;
  counts.note(Homed{HomingEnd::Arrived, {}});
  counts.note(Homed{HomingEnd::Lost, {}});
  counts.note(Driven{});
  EXPECT_EQ(counts.homingsTried, 2);
  EXPECT_EQ(counts.homingsArrived, 1);
}

} // namespace
} // namespace homeward
