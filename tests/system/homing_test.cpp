// SPDX-License-Identifier: GPL-3.0-or-later
#include "program.h"
#include "test_paths.h"

#include <homeward/homing/homing_method.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace homeward
{
namespace
{

using nlohmann::json;
using testing::HasSubstr;

/** A data set of some views of the sample world, made by the program. */
struct HomingProgram : testing::Test
{
  static void SetUpTestSuite()
  {
    folder = new Folder; // NOLINT(cppcoreguidelines-owning-memory): for the whole suite
    const ProgramRun run =
        runProgram("evaluate data-set --world " + (dataDir() / "worlds/rooms.sdf").string() +
                   " --count 24 --threads 1 --exact-optics --gray -o " + set());
    ASSERT_EQ(run.status, 0) << run.output;
  }
  static void TearDownTestSuite() { delete folder; } // NOLINT(cppcoreguidelines-owning-memory)

  static std::string set() { return *folder / "set"; }

  static inline Folder *folder = nullptr;
};

TEST_F(HomingProgram, homeFromAPictureToItselfIsNoTurn)
{
  const std::string picture = set() + "/day_00000.png";
  const std::string home = "home --current " + picture + " --snapshot " + picture + " --camera " +
                           set() + "/camera.yaml --json - --method ";
  for (const std::string &method : homingMethodNames()) {
    const ProgramRun run = runProgram(home + method);
    ASSERT_EQ(run.status, 0) << run.output;
    const json answer = json::parse(run.data);
    EXPECT_EQ(answer["command"], "home");
    EXPECT_NEAR(answer["heading_change_rad"].get<double>(), 0.0, 0.02) << method;
    EXPECT_LT(answer["distance_proxy"].get<double>(), 0.2) << method;
    EXPECT_TRUE(answer["direction_rad"].is_number());
    EXPECT_TRUE(answer["confidence"].is_number());
  }
}

TEST_F(HomingProgram, evaluatesADataSetTheSameWithOneThreadAndWithTwo)
{
  std::vector<json> results;
  for (const char *threads : {"1", "2"}) {
    const ProgramRun run =
        runProgram("evaluate homing --data " + set() + " --methods minwarping-72 compass --json -" +
                   " --threads " + threads);
    ASSERT_EQ(run.status, 0) << run.output;
    json pair = json::parse(run.data)["light_pairs"][0];
    for (auto &method : pair["methods"]) {
      EXPECT_GT(method["ms"].get<double>(), 0.0);
      method.erase("ms");
    }
    EXPECT_TRUE(pair["methods"]["minwarping-72"].contains("share_over_90"));
    EXPECT_FALSE(pair["methods"]["compass"].contains("mean_deg")) << "it gives no direction";
    results.push_back(pair);
  }
  EXPECT_EQ(results[0], results[1]);
}

TEST_F(HomingProgram, refusesWhatItCannotUse)
{
  const auto refused = [](const std::string &arguments, const std::string &named) {
    const ProgramRun run = runProgram(arguments);
    EXPECT_EQ(run.status, 2) << run.output;
    EXPECT_THAT(run.output, HasSubstr(named));
  };
  refused("evaluate homing --data " + set() + " --light-now dusk", "'dusk', it has day");
  refused("evaluate homing --data nowhere", "nowhere");
  refused("evaluate homing --data " + set() + " --world x.sdf", "excludes");
  const std::string picture = set() + "/day_00000.png";
  refused("home --current " + picture + " --snapshot " + picture, "--camera");
  refused("home --snapshot none.png --current " + picture + " --camera " + set() + "/camera.yaml",
          "none.png");
}

} // namespace
} // namespace homeward
