// SPDX-License-Identifier: GPL-3.0-or-later
// Every shell command of the documents: those that end soon are run as they stand there, the others
// are named here with the test that covers them. Of all, the options must be in the program's help.
#include "program.h"
#include "room_map.h"
#include "test_paths.h"

#include <gmock/gmock.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <set>

namespace homeward
{
namespace
{

namespace fs = std::filesystem;

struct DocumentedCommand
{
  std::string page;
  std::string text;
};

/** Where a command that begins so is run, and why not here. */
const std::map<std::string, std::string> kElsewhere{
    {"scripts/explore-lab", "builds all; its exploration is Explore.MapsTheLaboratory..."},
    {"scripts/test", "runs this test"},
    {"homeward explore ", "minutes: Explore.*, RigTest.ExploresOverSockets, tutorial.11-explore"},
    {"homeward navigate ", "needs an explored map: Explore.*, tutorial.12-navigate"},
    {"homeward map serve ", "runs until it is stopped: system.dashboard"},
    {"homeward replay ", "needs a recording: Replay.*"},
    {"homeward rig check ", "needs a robot: RigTest.Check*"},
    {"homeward evaluate homing ", "minutes: HomingProgram.evaluatesADataSet..."},
    {"homeward evaluate arrival ", "minutes: ArrivalTrials.*"},
    {"homeward evaluate places ", "minutes: PlaceTrial.*, Localize.ANetworkMustBeOne"},
    {"homeward evaluate rows ", "minutes: Localize.AnExampleOfEveryRowDistanceAndLight"},
    {"homeward evaluate mission ", "hours: EvaluateMission.*"},
    {"homeward evaluate data-set ", "minutes: HomingProgram.*"},
    {"homeward localize ", "needs two data sets: Localize.FollowsADrivePastKnownPlaces"},
    {"pioneer-sim ", "runs until it is stopped: RigTest.*"},
    {"cmake -S tutorial/", "tutorial.build"},
    {"cmake --build build/", "tutorial.build"},
    {"build/", "tutorial.*"},
    {"tutorial/15-real-pioneer/rehearse", "tutorial.15-real-pioneer"}};

/** The reason not to run a command here, as its beginning in kElsewhere; nothing for the others. */
std::optional<std::string> elsewhere(const std::string &command)
{
  for (const auto &[beginning, reason] : kElsewhere) {
    if (command.starts_with(beginning)) {
      return beginning;
    }
  }
  return std::nullopt;
}

/** "a b|c d" as "a b d" and "a c d". */
std::vector<std::string> alternatives(const std::string &command)
{
  const std::size_t bar = command.find('|');
  if (bar == std::string::npos) {
    return {command};
  }
  const std::size_t begin = command.rfind(' ', bar) + 1;
  const std::size_t end = command.find(' ', bar);
  std::vector<std::string> all;
  std::istringstream words(command.substr(begin, end - begin));
  for (std::string word; std::getline(words, word, '|');) {
    all.push_back(command.substr(0, begin) + word + command.substr(end));
  }
  return all;
}

/** The commands of a page's blocks that begin with ```sh, without their comments. */
void addCommands(const fs::path &page, std::vector<DocumentedCommand> &commands)
{
  std::istringstream lines(fileText(page.string()));
  bool inside = false;
  std::string command;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) {
      inside = line == "```sh";
      continue;
    }
    if (!inside) {
      continue;
    }
    command += line.substr(0, line.find(" #"));
    command.erase(command.find_last_not_of(' ') + 1);
    if (command.ends_with('\\')) {
      command.pop_back();
      continue;
    }
    for (const std::string &one : alternatives(command)) {
      commands.push_back({page.filename().string(), one});
    }
    command.clear();
  }
}

std::vector<DocumentedCommand> documentedCommands()
{
  const fs::path root = dataDir().parent_path();
  std::vector<fs::path> pages;
  for (const fs::path &folder : {root / "doc", root / "doc/tutorials"}) {
    for (const auto &entry : fs::directory_iterator(folder)) {
      if (entry.path().extension() == ".md") {
        pages.push_back(entry.path());
      }
    }
  }
  std::sort(pages.begin(), pages.end());
  pages.insert(pages.begin(), root / "README.md");
  std::vector<DocumentedCommand> commands;
  for (const fs::path &page : pages) {
    addCommands(page, commands);
  }
  return commands;
}

const std::string kProgram = "homeward ";

/** What the documents speak of, in a folder: maps, pictures, a log. */
void prepare(const Folder &folder)
{
  const SyntheticRoom room(3, 10.0, 7.0);
  constexpr int kPlaces = 13; // node 12 is spoken of
  std::vector<Pose2> places;
  places.reserve(kPlaces);
  for (int i = 0; i < kPlaces; ++i) {
    places.push_back({-3.0 + 0.5 * i, i % 2 == 0 ? 1.0 : -1.0, 0.4 * i});
  }
  writeRoomMap(folder / "house.hwm", room, places);
  fs::copy_file(folder / "house.hwm", folder / "lab.hwm");
  writeRoomMap(folder / "monday.hwm", room, {{-1.5, 0.0, 0.5}, {1.5, 0.5, -1.0}, {3.5, -2.0, 2.0}});
  writeRoomMap(folder / "tuesday.hwm", room,
               {{1.45, 0.55, 1.0}, {3.4, 2.2, 0.3}, {-1.45, 0.05, -2.0}});

  fs::create_directory_symlink(dataDir(), folder / "data");
  fs::copy_file(dataDir() / "samples/sample.log.gz", folder / "intel.log.gz");
  fs::copy_file(dataDir() / "cameras/sim_nominal.yaml", folder / "camera.yaml");
  const cv::Mat mirror = cv::imread((dataDir() / "samples/mirror.jpg").string());
  cv::imwrite(folder / "now.png", mirror);
  cv::imwrite(folder / "home.png", mirror);
  cv::Mat large; // of the size of data/cameras/example_mirror.yaml
  cv::resize(mirror, large, cv::Size(1920, 1080));
  cv::imwrite(folder / "picture.jpg", large);
}

TEST(Documents, TheirCommandsRun)
{
  const Folder folder;
  prepare(folder);
  int ran = 0;
  for (const DocumentedCommand &command : documentedCommands()) {
    if (elsewhere(command.text)) {
      continue;
    }
    ASSERT_TRUE(command.text.starts_with(kProgram))
        << command.page << ": " << command.text << "\nis in nobody's test; see kElsewhere";
    const ProgramRun run =
        runProgram(command.text.substr(kProgram.size()), "cd " + folder / "" + " && ");
    EXPECT_EQ(run.status, 0) << command.page << ": " << command.text << "\n" << run.output;
    ++ran;
  }
  EXPECT_GE(ran, 9);
}

TEST(Documents, TheirOptionsAreInTheHelp)
{
  for (const DocumentedCommand &command : documentedCommands()) {
    if (!command.text.starts_with(kProgram)) {
      continue;
    }
    const ProgramRun help =
        runProgram(command.text.substr(kProgram.size(), command.text.find(" -") - kProgram.size()) +
                   " --help");
    EXPECT_EQ(help.status, 0) << command.page << ": " << command.text << "\n" << help.output;
    std::istringstream words(command.text);
    for (std::string word; words >> word;) {
      if (word.starts_with("-") && word != "-") {
        EXPECT_THAT(help.data, testing::ContainsRegex("[ ,]" + word + "[ ,=\n]"))
            << command.page << ": " << command.text;
      }
    }
  }
}

TEST(Documents, WhatIsTestedElsewhereIsStillInThem)
{
  std::set<std::string> used;
  for (const DocumentedCommand &command : documentedCommands()) {
    if (const auto beginning = elsewhere(command.text)) {
      used.insert(*beginning);
    }
  }
  for (const auto &[beginning, reason] : kElsewhere) {
    EXPECT_TRUE(used.contains(beginning)) << beginning << " is in no document any more";
  }
}

} // namespace
} // namespace homeward
