// SPDX-License-Identifier: GPL-3.0-or-later
#include "program.h"
#include "synthetic_room.h"
#include "test_paths.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>

namespace homeward
{
namespace
{

/** A data set of panoramas along a line through a room. */
struct Localize : testing::Test
{
  std::string makeSet(const std::string &name, double first, double step, int count,
                      int width = 360)
  {
    std::string at = folder / name;
    std::filesystem::create_directory(at);
    std::ofstream(at + "/panorama.yaml")
        << "projection: equirectangular\nelevation_min_deg: -45\nelevation_max_deg: 35\n"
        << "forward_column: " << width / 2.0 - 0.5 << "\ncolumns: clockwise\n";
    std::ofstream poses(at + "/poses.csv");
    poses << "file,x_m,y_m,heading_rad,light\n";
    for (int i = 0; i < count; ++i) {
      const Pose2 pose{first + step * i, 0.2, 0.7 * i};
      const std::string file = std::to_string(9 - i) + ".png"; // names in no order
      cv::imwrite(std::filesystem::path(at) / file,
                  room.view(pose, {}, {.width = width, .height = 80}).image);
      poses << file << ',' << pose.x << ',' << pose.y << ',' << pose.heading << ",day\n";
    }
    return at;
  }

  static void expectRefusal(const ProgramRun &run, const std::string &named)
  {
    EXPECT_THAT(run.status, testing::AnyOf(1, 2)) << run.output;
    EXPECT_THAT(run.output, testing::HasSubstr(named));
    EXPECT_EQ(std::count(run.output.begin(), run.output.end(), '\n'), 1) << run.output;
  }

  SyntheticRoom room{41, 6.0, 5.0};
  Folder folder;
};

TEST_F(Localize, FollowsADrivePastKnownPlaces)
{
  const std::string train = makeSet("train", -1.8, 0.9, 5);
  const std::string test = makeSet("test", -1.75, 0.9, 5);
  const std::string localize = "localize --train " + train + " --test " + test + " --json - ";
  for (const char *how : {"--global", "--local", "--signature edge_bytes"}) {
    const ProgramRun run = runProgram(localize + how);
    ASSERT_EQ(run.status, 0) << run.output;
    const auto json = nlohmann::json::parse(run.data);
    EXPECT_EQ(json["success_ratio"], 1.0);
    ASSERT_EQ(json["images"].size(), 5U);
    EXPECT_EQ(json["images"][1]["file"], "8.png") << "the order of poses.csv";
    EXPECT_EQ(json["images"][1]["node"], 1);
    EXPECT_EQ(json["images"][1]["correct"], true);
    EXPECT_GT(json["images"][1]["probability"], 0.2);
  }
}

TEST_F(Localize, DrawsWhatItBelieved)
{
  const std::string train = makeSet("train", -1.8, 0.9, 5);
  const std::string picture = folder / "beliefs.png";
  const ProgramRun run = runProgram("localize --train " + train + " --test " + train +
                                    " --picture " + picture + " --kidnapping 0.05");
  ASSERT_EQ(run.status, 0) << run.output;
  EXPECT_GT(cv::imread(picture).cols, 300);
}

TEST_F(Localize, AnExampleOfEveryRowDistanceAndLight)
{
  const ProgramRun run =
      runProgram("evaluate rows --world " + (dataDir() / "worlds/lab.sdf").string() +
                 " --drives 1 --signatures sad --lights night --json -");
  ASSERT_EQ(run.status, 0) << run.output;
  const auto json = nlohmann::json::parse(run.data);
  ASSERT_EQ(json["columns"].size(), 8U);
  EXPECT_GE(json["columns"][0]["success_ratio"]["sad"].get<double>(), 0.5);
  EXPECT_EQ(json["columns"][7]["light_map"], "night");
  expectRefusal(runProgram("evaluate rows --light-distance 0.25"), "0.25");
}

TEST_F(Localize, ANetworkMustBeOne)
{
  const std::string data = makeSet("train", -1.8, 0.9, 3);
  const std::string text = folder / "text.onnx";
  std::ofstream(text) << "no network";
  const std::string evaluate = "evaluate places --data " + data + " --network ";
  expectRefusal(runProgram(evaluate + text), "text.onnx is no network");
  expectRefusal(runProgram(evaluate + (folder / "none.onnx")), "none.onnx");
}

TEST_F(Localize, RefusesBadInput)
{
  const std::string train = makeSet("train", -1.8, 0.9, 3);
  const std::string other = makeSet("other", -1.8, 0.9, 3, 180);
  const std::string begin = "localize --train " + train + " --test ";
  expectRefusal(runProgram(begin + other), "different sizes");
  expectRefusal(runProgram(begin + folder / "none"), "none");
  std::filesystem::create_directory(folder / "empty");
  expectRefusal(runProgram(begin + folder / "empty"), "poses.csv");
  expectRefusal(runProgram(begin + train + " --signature gist"), "gist");
  expectRefusal(runProgram("localize --train nowhere.hwm --test " + train), "nowhere.hwm");
  const std::string broken = makeSet("broken", -1.8, 0.9, 3);
  std::ofstream(broken + "/8.png") << "no picture";
  expectRefusal(runProgram(begin + broken), "8.png");
}

} // namespace
} // namespace homeward
