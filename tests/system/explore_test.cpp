// SPDX-License-Identifier: GPL-3.0-or-later
#include "program.h"
#include "test_paths.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace homeward
{
namespace
{

std::string lab()
{
  return (dataDir() / "worlds/lab.sdf").string();
}

TEST(Explore, MapsTheLaboratoryAndDrivesBackThroughIt)
{
  const Folder folder;
  const std::string map = folder / "lab.hwm";
  const ProgramRun run =
      runProgram("explore --world " + lab() + " --map " + map + " --json " + folder / "lab.json");
  ASSERT_EQ(run.status, 0) << run.output;
  const auto json = nlohmann::json::parse(fileText(folder / "lab.json"));
  EXPECT_EQ(json["outcome"], "done");
  EXPECT_EQ(json["collisions"], 0);
  EXPECT_GE(json["truth"]["coverage"].get<double>(), 0.9);
  EXPECT_EQ(json["truth"]["false_edges"], 0);
  EXPECT_THAT(run.output, testing::HasSubstr("EXPLORATION DONE"));

  const ProgramRun again = runProgram("explore --resume --world " + lab() + " --map " + map);
  EXPECT_EQ(again.status, 0) << again.output;
  EXPECT_THAT(again.output, testing::HasSubstr("homings 0 of 0 arrived\ndistance 0.0 m"));

  const std::string last = std::to_string(json["nodes"].get<int>() - 1);
  const ProgramRun drive = runProgram("navigate --world " + lab() + " --map " + map + " --from " +
                                      last + " --to 0 --json " + folder / "drive.json");
  ASSERT_EQ(drive.status, 0) << drive.output;
  const auto driven = nlohmann::json::parse(fileText(folder / "drive.json"));
  EXPECT_LE(driven["truth"]["error_m"].get<double>(), 0.5);

  EXPECT_EQ(runProgram("map render " + map + " -o " + folder / "lab.png").status, 0);
  EXPECT_GT(std::filesystem::file_size(folder / "lab.png"), 10000U);
  const auto exported = runProgram("map export " + map + " --format json");
  EXPECT_FALSE(nlohmann::json::parse(exported.data).empty());
  const ProgramRun info = runProgram("map info " + map + " --json -");
  EXPECT_EQ(nlohmann::json::parse(info.data)["nodes"], json["nodes"]);
  EXPECT_THAT(info.output, testing::HasSubstr("node 0: "));
}

TEST(Explore, TheSameSeedGivesTheSameMapWithOneThreadOrTwo)
{
  const Folder folder;
  const std::string common = "explore --world " + lab() + " --max-time 120 --seed 3 --map ";
  EXPECT_EQ(runProgram(common + folder / "one.hwm" + " --threads 1").status, 1);
  EXPECT_EQ(runProgram(common + folder / "two.hwm" + " --threads 2").status, 1);
  const ProgramRun one = runProgram("map export --canonical " + folder / "one.hwm");
  const ProgramRun two = runProgram("map export --canonical " + folder / "two.hwm");
  EXPECT_EQ(one.status, 0);
  EXPECT_THAT(one.output, testing::HasSubstr("node"));
  EXPECT_EQ(one.output, two.output);
}

} // namespace
} // namespace homeward
