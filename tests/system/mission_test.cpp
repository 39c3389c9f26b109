// SPDX-License-Identifier: GPL-3.0-or-later
#include "program.h"
#include "test_paths.h"

#include <csignal>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace homeward
{
namespace
{

using nlohmann::json;

/** Short explorations: what is tested is how they are run and kept. */
struct EvaluateMission : testing::Test
{
  std::string common() const
  {
    return "evaluate mission --worlds " + (dataDir() / "worlds/lab.sdf").string() +
           " --max-time 40 --goals 1 ";
  }

  json result(const std::string &name) const { return json::parse(fileText(folder / name)); }

  /** But for what the wall clock says. */
  json timeless(const std::string &name) const
  {
    json value = result(name);
    value.erase("wall_time_s");
    value.erase("explore_wall_time_s");
    return value;
  }

  Folder folder;
};

/** Starts the program and kills it as soon as it has said one line. */
void killAfterALine(const std::string &arguments)
{
  const std::string command = "echo $$; exec " + std::string(HOMEWARD_PROGRAM) + " " + arguments;
  FILE *pipe = popen(command.c_str(), "r"); // NOLINT(cert-env33-c)
  ASSERT_NE(pipe, nullptr);
  std::array<char, 400> line{};
  ASSERT_NE(std::fgets(line.data(), line.size(), pipe), nullptr);
  const int process = std::stoi(line.data());
  ASSERT_NE(std::fgets(line.data(), line.size(), pipe), nullptr);
  EXPECT_THAT(line.data(), testing::StartsWith("lab-1: "));
  EXPECT_EQ(::kill(process, SIGKILL), 0);
  const int ended = pclose(pipe);
  EXPECT_TRUE(WIFSIGNALED(ended)) << "it had come to its end already";
}

TEST_F(EvaluateMission, goesOnAfterItWasKilledAndDoesNotDependOnJobs)
{
  const std::string out = folder / "one";
  const std::string study = common() + "--seeds 2 --out " + out;
  killAfterALine(study + " --jobs 1");
  const std::string first = fileText(out + "/lab-1.json");
  EXPECT_THAT(first, testing::HasSubstr("\"outcome\""));
  EXPECT_FALSE(std::filesystem::exists(out + "/lab-2.json"));
  EXPECT_FALSE(std::filesystem::exists(out + "/summary.json"));

  const ProgramRun resumed = runProgram(study + " --jobs 1");
  ASSERT_EQ(resumed.status, 0) << resumed.output;
  EXPECT_THAT(resumed.output, testing::HasSubstr("lab-1: is there\n"));
  EXPECT_EQ(fileText(out + "/lab-1.json"), first) << "it was made again";

  const ProgramRun both =
      runProgram(common() + "--seeds 2 --jobs 2 --json - --out " + folder / "two");
  ASSERT_EQ(both.status, 0) << both.output;
  for (const char *name : {"lab-1.json", "lab-2.json"}) {
    EXPECT_EQ(timeless(std::string("one/") + name), timeless(std::string("two/") + name));
  }
  EXPECT_EQ(timeless("one/summary.json"), timeless("two/summary.json"));
  EXPECT_EQ(json::parse(both.data), result("two/summary.json"));

  const json summary = result("two/summary.json").at("worlds").at("lab");
  EXPECT_EQ(summary.at("runs"), 2);
  EXPECT_EQ(summary.at("goals"), 2);
  EXPECT_EQ(summary.at("reached"), 2);
  EXPECT_EQ(summary.at("coverage_min"),
            std::min(result("two/lab-1.json")["truth"]["coverage"].get<double>(),
                     result("two/lab-2.json")["truth"]["coverage"].get<double>()));
  EXPECT_THAT(fileText(folder / "two/lab-coverage.svg"), testing::HasSubstr("seed 2"));
  EXPECT_EQ(runProgram("map info " + folder / "two/lab-2.hwm").status, 0);

  const ProgramRun other = runProgram(study + " --light night");
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.output, testing::ContainsRegex("lab-1.json was made with other options "
                                                   "\\(light: \"day\", now \"night\"\\)[^\n]*\n$"));
}

TEST_F(EvaluateMission, refusesInOneLine)
{
  const auto expectRefusal = [](const std::string &arguments, const std::string &named) {
    const ProgramRun run = runProgram(arguments);
    EXPECT_EQ(run.status, 2) << run.output;
    EXPECT_THAT(run.output, testing::HasSubstr(named));
    EXPECT_EQ(std::count(run.output.begin(), run.output.end(), '\n'), 1) << run.output;
  };
  const std::string out = " --out " + folder / "out";
  expectRefusal("evaluate mission --worlds nowhere.sdf" + out, "nowhere.sdf");
  expectRefusal(common() + "--light noon" + out, "noon");
  expectRefusal(common() + "--light-now noon" + out, "noon");
  expectRefusal(common() + "--rig " + (dataDir() / "rigs/pioneer-sim.yaml").string() + out,
                "pioneer-sim.yaml");
  const std::string twice = (dataDir() / "worlds/lab.sdf").string();
  expectRefusal("evaluate mission --worlds " + twice + " " + twice + out, "'lab'");
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));

  std::ofstream(folder / "file") << "mine";
  expectRefusal(common() + "--out " + folder / "file", "file");
  std::filesystem::create_directory(folder / "damaged");
  std::ofstream(folder / "damaged/lab-1.json") << "{";
  expectRefusal(common() + "--out " + folder / "damaged", "lab-1.json");
}

} // namespace
} // namespace homeward
