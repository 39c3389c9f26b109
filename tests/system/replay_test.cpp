// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab_runs.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <csignal>
#include <thread>

namespace homeward
{
namespace
{

/** Debian's own rosbag, without ROS around it. */
constexpr const char *kRosbag = "/usr/bin/python3 /usr/bin/rosbag";

class Replay : public LabRuns
{
protected:
  void SetUp() override
  {
    if (runProgram("replay missing.bag --reindex").output.find("built without") !=
        std::string::npos) {
      GTEST_SKIP() << "the program was built without ROS bags";
    }
  }

  static bool hasRosbag() { return std::filesystem::exists("/usr/bin/rosbag"); }

  std::string bag = folder / "drive.bag";
};

TEST_F(Replay, MakesTheSameMapAndTheSameWays)
{
  const ProgramRun run =
      runProgram(exploration(90, "run.hwm") + "--record-split 5 --record " + bag);
  EXPECT_EQ(run.status, 1) << run.output; // the time was over
  EXPECT_THAT(run.output, testing::HasSubstr("recorded "));
  EXPECT_TRUE(std::filesystem::exists(folder / "drive_1.bag"));
  const ProgramRun again =
      runProgram("replay " + bag + " --map " + folder / "again.hwm" + " --json " + folder / "j");
  EXPECT_EQ(again.status, 0) << again.output;
  EXPECT_THAT(again.output, testing::HasSubstr("every command was as recorded"));
  EXPECT_EQ(canonical("again.hwm"), canonical("run.hwm"));
  const auto json = nlohmann::json::parse(fileText(folder / "j"));
  EXPECT_EQ(json["replay"]["same"], true);
  EXPECT_EQ(json["replay"]["whole"], true);
  // Recorded or not, the run is the same.
  runProgram(exploration(90, "plain.hwm"));
  EXPECT_EQ(canonical("plain.hwm"), canonical("run.hwm"));

  const std::string navigation =
      "navigate --map " + folder / "run.hwm" + " --to 0,1 --from 1 --record " + folder / "nav.bag";
  const ProgramRun drive = runProgram(navigation);
  EXPECT_EQ(drive.status, 0) << drive.output;
  const ProgramRun driveAgain = runProgram("replay " + folder / "nav.bag");
  EXPECT_EQ(driveAgain.status, 0) << driveAgain.output;
  EXPECT_THAT(driveAgain.output, testing::HasSubstr("2 of 2 goals reached"));
}

TEST_F(Replay, AfterAKillGoesAsFarAsTheLastClosedChunk)
{
  const std::string quiet = " >/dev/null 2>&1 & PID=$!; ";
  const std::string wait = "while [ \"$(stat -c %s " + bag +
                           " 2>/dev/null || echo 0)\" -lt 4000000 ]; do sleep 0.05; "
                           "done; kill -9 $PID; wait $PID 2>/dev/null; ";
  const std::string killed = std::string(HOMEWARD_PROGRAM) + " " + exploration(600, "killed.hwm") +
                             "--record " + bag + quiet + wait;
  EXPECT_THAT(runProgram("replay " + bag + " --map " + folder / "again.hwm", killed).output,
              testing::HasSubstr("--reindex"));
  const ProgramRun repair = runProgram("replay " + bag + " --reindex");
  EXPECT_EQ(repair.status, 0) << repair.output;
  const ProgramRun again =
      runProgram("replay " + bag + " --map " + folder / "again.hwm" + " --json " + folder / "j");
  EXPECT_EQ(again.status, 0) << again.output;
  const auto json = nlohmann::json::parse(fileText(folder / "j"));
  EXPECT_EQ(json["replay"]["same"], true);
  EXPECT_EQ(json["replay"]["whole"], false);
  // What the killed robot had seen first is the same.
  const std::string first = canonical("again.hwm").substr(0, 400);
  EXPECT_THAT(first, testing::HasSubstr("node 0"));
  if (hasRosbag()) {
    EXPECT_EQ(runProgram("--version", std::string(kRosbag) + " info " + bag + " && ").status, 0);
  }
}

TEST_F(Replay, RosbagInfoReadsWhatWasRecorded)
{
  if (!hasRosbag()) {
    GTEST_SKIP() << "python3-rosbag is not installed";
  }
  runProgram(exploration(10, "run.hwm") + "--record " + bag);
  const std::string info =
      runProgram("--version", std::string(kRosbag) + " info " + bag + " && ").output;
  for (const char *type : {"sensor_msgs/CompressedImage", "sensor_msgs/LaserScan",
                           "nav_msgs/Odometry", "geometry_msgs/Twist", "std_msgs/String"}) {
    EXPECT_THAT(info, testing::HasSubstr(type));
  }
}

TEST_F(Replay, MakesAMapOfABagOfAnotherProgram)
{
  if (!hasRosbag()) {
    GTEST_SKIP() << "python3-rosbag is not installed";
  }
  runProgram(exploration(120, "run.hwm") + "--record " + bag);
  // Raw pictures, other topics, no events, compressed: as any recorder may have it.
  const auto script =
      std::filesystem::path(HOMEWARD_DATA_DIR).parent_path() / "tests/system/foreign_bag.py";
  const std::string foreign = folder / "foreign.bag";
  const ProgramRun made = runProgram("--version", "/usr/bin/python3 " + script.string() + " " +
                                                      bag + " " + foreign + " && ");
  ASSERT_EQ(made.status, 0) << made.output;
  const std::string build = " --build-map --map " + folder / "driven.hwm";
  const ProgramRun named =
      runProgram("replay " + foreign + build + " --image-topic /omni/image_raw --json -");
  EXPECT_EQ(named.status, 0) << named.output;
  const auto json = nlohmann::json::parse(named.data);
  EXPECT_GE(json["nodes"], 3);
  EXPECT_GE(json["edges"], 2);
  EXPECT_EQ(runProgram("map check " + folder / "driven.hwm").status, 0);
  const ProgramRun mission = runProgram("replay " + foreign + " --map " + folder / "no.hwm");
  EXPECT_NE(mission.status, 0);
  EXPECT_THAT(mission.output, testing::HasSubstr("--build-map"));
}

} // namespace
} // namespace homeward
