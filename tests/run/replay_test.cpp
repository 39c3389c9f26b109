// SPDX-License-Identifier: GPL-3.0-or-later
#include "../contract/test_room.h"
#include "../store/store_fixture.h"
#include "test_robot.h"

#include <homeward/record/recording_devices.h>
#include <homeward/record/replayed_devices.h>
#include <homeward/run/run_mission.h>
#include <homeward/sim/simulator.h>
#include <homeward/store/export.h>

#include <gmock/gmock.h>

#include <deque>

namespace homeward
{
namespace
{

/** An exploration of a small room, on whatever devices. */
class Replay : public StoreTest
{
protected:
  /** Explores; the canonical map, as far as it got. */
  std::string explore(const Devices &devices, const PilotOptions &options,
                      const std::atomic<bool> &stopped)
  {
    std::filesystem::remove(path());
    MapHeader header = smallHeader();
    header.panorama = options.panorama;
    MapFile file = MapFile::create(path(), header);
    const Explorer explorer({.forwardDistance = 1.0});
    Pilot pilot(devices, m_robot, m_camera, options, stopped);
    const auto enough = [&] { return toSeconds(devices.clock.now()) > 60.0; };
    MissionCounts counts;
    try {
      runMission(explorer, explorer.start(file.map()), pilot, file.map(), &file, devices.clock,
                 counts, enough, [](const auto & /*step*/) {});
    }
    catch (const RecordingEnded &) {
      ended = true;
    }
    return exportCanonical(file);
  }

  /** Explores a simulated room; its ticks go to `ticks`. */
  std::string record()
  {
    SimulatorOptions options;
    options.start = Pose2{2.0, 2.0, 0.0};
    Simulator simulator{share(makeRoom(5.0F, 4.0F)), m_robot, m_camera, options};
    RecordingDevices recording(simulator.clock(), simulator.base(), simulator.laser(),
                               simulator.camera(), stop,
                               [this](Tick tick) { ticks.push_back(std::move(tick)); });
    std::string map = explore(
        {recording.clock(), recording.base(), recording.laser(), recording.camera()}, {}, stop);
    recording.finish();
    return map;
  }

  std::string replay(const PilotOptions &options = {})
  {
    std::deque<Tick> left(ticks.begin(), ticks.end());
    const auto next = [&]() -> std::optional<Tick> {
      if (left.empty()) {
        return std::nullopt;
      }
      Tick tick = std::move(left.front());
      left.pop_front();
      return tick;
    };
    std::atomic<bool> stopped = false;
    ReplayedDevices replayed(next, [&] { stopped = true; });
    std::string map = explore(
        {replayed.clock(), replayed.base(), replayed.laser(), replayed.camera()}, options, stopped);
    divergence = replayed.divergence();
    return map;
  }

  std::vector<Tick> ticks;
  std::atomic<bool> stop = false;
  bool ended = false;
  std::optional<Divergence> divergence;

private:
  RobotDescription m_robot = testRobot();
  MirrorCamera m_camera = testCamera();
};

TEST_F(Replay, MakesTheMapOfTheRun)
{
  const std::string map = record();
  EXPECT_THAT(map, testing::HasSubstr("node 1"));
  EXPECT_EQ(replay(), map);
  EXPECT_FALSE(divergence);
  EXPECT_FALSE(ended);
}

TEST_F(Replay, OfAPartMakesTheBeginningOfTheMap)
{
  record();
  ticks.resize(ticks.size() / 2);
  EXPECT_THAT(replay(), testing::HasSubstr("node 0"));
  EXPECT_FALSE(divergence);
  EXPECT_TRUE(ended);
}

TEST_F(Replay, SaysWhenAProgramFirstDoesOtherwise)
{
  record();
  PilotOptions slow;
  slow.motion.maxTurnRate = 0.5;
  replay(slow);
  ASSERT_TRUE(divergence);
  EXPECT_GT(toSeconds(divergence->at), 0.0);
  ASSERT_TRUE(divergence->recorded && divergence->now);
  EXPECT_LT(std::abs(divergence->now->w), std::abs(divergence->recorded->w));
}

} // namespace
} // namespace homeward
