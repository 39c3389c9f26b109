// SPDX-License-Identifier: GPL-3.0-or-later
#include "folder.h"
#include "gallery.h"

#include <homeward/evaluation/barred_drive.h>
#include <homeward/evaluation/mission_trial_json.h>

#include <gmock/gmock.h>

namespace homeward
{
namespace
{

/** The beginning of a gallery's map. */
struct BarredDrives : testing::Test
{
  static void SetUpTestSuite()
  {
    explored = std::make_unique<Folder>();
    MissionTrialOptions options = galleryOptions();
    options.maxTime = 60.0;
    runMissionTrial(galleryTask(*explored / "map.hwm"), options, kStop);
  }

  static void TearDownTestSuite() { explored.reset(); }

  /** Short drives: what is tested is how they are made and watched. */
  BarredDrives() { options.navigating.homing.timeoutSeconds = 12.0; }

  GoalDriver driver(Simulator &simulator, RestlessWorld *restless = nullptr)
  {
    constexpr double kSeconds = 20.0;
    return {simulator,         options.robot, options.camera, options.navigating,
            options.navigator, restless,      kSeconds};
  }

  std::vector<BarredDrive> drive(std::size_t count)
  {
    Simulator simulator(scene, options.robot, options.camera);
    auto drives = driveAtBarriers(driver(simulator), file, truth, count, 1, kStop);
    EXPECT_FALSE(simulator.onStep) << "somebody still listens";
    return drives;
  }

  static inline const std::atomic<bool> kStop = false;
  static inline std::unique_ptr<Folder> explored;

  MissionTrialOptions options = galleryOptions();
  std::shared_ptr<const Scene> scene = share(gallery());
  MapFile file = MapFile::open(*explored / "map.hwm", MapFile::Access::Read);
  TruthLog truth = loadTruthLog(truthLogFile(*explored / "map.hwm")).value();
};

TEST_F(BarredDrives, meetBarriersOnEdgesOfTheMap)
{
  const std::vector<BarredDrive> drives = drive(2);
  ASSERT_EQ(drives.size(), 2U);
  EXPECT_NE(drives.front().edge, drives.back().edge);
  double longest = 0.0;
  for (const BarredDrive &barred : drives) {
    const Edge &edge = file.map().edge(barred.edge);
    EXPECT_EQ(std::set({barred.drive.from.value(), barred.drive.goal}), std::set({edge.a, edge.b}));
    EXPECT_GE(barred.barrierWidth, 1.0);
    EXPECT_LE(barred.barrierWidth, 3.0);
    EXPECT_EQ(barred.drive.collisions, 0);
    for (const double seconds : barred.meetings) {
      longest = std::max(longest, seconds);
      EXPECT_LE(seconds, barred.drive.seconds);
    }
  }
  EXPECT_GT(longest, 5.0) << "no barrier stood in the way";
  MissionTrial fewer;
  fewer.barred = drive(1);
  MissionTrial begun;
  begun.barred = {drives.front()};
  EXPECT_EQ(missionTrialJson(fewer), missionTrialJson(begun))
      << "the larger begins with the smaller";
}

TEST_F(BarredDrives, areMadeAmongPeople)
{
  Simulator simulator(scene, options.robot, options.camera);
  RestlessWorld restless(simulator, scene, {.people = 1}, 1);
  const std::vector<Eigen::Vector2d> before = restless.people();
  const std::vector<BarredDrive> drives =
      driveAtBarriers(driver(simulator, &restless), file, truth, 1, 1, kStop);
  EXPECT_EQ(drives.size(), 1U);
  EXPECT_NE(restless.people(), before) << "they stood still";
  EXPECT_TRUE(simulator.onStep) << "they stand still from now on";
}

TEST_F(BarredDrives, areAsManyAsThereAreEdgesToBar)
{
  for (auto &[id, pose] : truth.nodes) {
    pose = truth.start; // too near to one another
  }
  EXPECT_TRUE(drive(2).empty());
}

// 0 - 1 - 2
//   \   /
//     3
struct FoundNoWay : testing::Test
{
  FoundNoWay()
  {
    for (int i = 0; i < 4; ++i) {
      map.apply(NodeAdded{{map.nextNodeId()}});
    }
    for (const auto &[a, b] :
         {std::pair(0, 1), std::pair(1, 2), std::pair(0, 3), std::pair(3, 2)}) {
      map.apply(EdgeAdded{{map.nextEdgeId(), NodeId{a}, NodeId{b}}});
    }
    end.here = NodeId{0};
    end.goal = NodeId{1};
  }

  bool found(Outcome outcome = Outcome::Failed) const
  {
    return foundNoWay(map, outcome, end, EdgeId{0});
  }

  TopologicalMap map;
  NavigatorState end;
};

TEST_F(FoundNoWay, isRightWhenTheOtherWayWasTriedToo)
{
  end.failures = {{EdgeId{0}, 2}};
  EXPECT_FALSE(found()) << "3 was not tried";
  end.failures.emplace(EdgeId{3}, 1);
  EXPECT_TRUE(found());
  EXPECT_FALSE(found(Outcome::Stopped));
  end.here.reset();
  EXPECT_FALSE(found()) << "it was lost";
}

TEST_F(FoundNoWay, isRightWhenTheMapHasNoOtherWay)
{
  map.apply(EdgeRemoved{EdgeId{2}});
  EXPECT_TRUE(found());
}

} // namespace
} // namespace homeward
