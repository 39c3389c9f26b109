// SPDX-License-Identifier: GPL-3.0-or-later
#include "program.h"
#include "room_map.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

namespace homeward
{
namespace
{

using ::testing::HasSubstr;

// Places 0 and 3 are one place, seen in two headings:
//
//     0 -- 1 -- 2 -- 3
class MapCommand : public ::testing::Test
{
protected:
  MapCommand()
  {
    writeRoomMap(file, SyntheticRoom(3, 10.0, 7.0),
                 {{-1.5, 0.0, 0.5}, {1.5, 0.5, -1.0}, {3.5, -2.0, 2.0}, {-1.4, 0.05, -2.0}});
  }

  ProgramRun map(const std::string &arguments) const { return runProgram("map " + arguments); }

  std::string canonical() const { return map("export --canonical " + file).data; }

  /** One line that says what is wrong; the map stays as it is. */
  void expectRefused(const std::string &arguments, const std::string &said) const
  {
    const std::string before = canonical();
    const ProgramRun run = map(arguments);
    EXPECT_THAT(run.status, testing::AnyOf(1, 2)) << run.output;
    EXPECT_THAT(run.output, HasSubstr(said));
    EXPECT_EQ(std::count(run.output.begin(), run.output.end(), '\n'), 1) << run.output;
    EXPECT_EQ(canonical(), before);
  }

  Folder folder;
  std::string file = folder / "room.hwm";
};

TEST_F(MapCommand, EditsAreMadeListedAndUndone)
{
  const std::string before = canonical();
  EXPECT_EQ(map("edit rename " + file + " 1 kitchen").data, "edit 1: node 1 is kitchen\n");
  EXPECT_THAT(map("info " + file).data, HasSubstr("node 1 kitchen: - 0 - 2"));
  EXPECT_EQ(map("edit no-go " + file + " kitchen 2").data, "edit 2: the edge 1 - 2 is no-go\n");
  EXPECT_EQ(map("edit no-go --lift " + file + " 2 1").data,
            "edit 3: the edge 2 - 1 may be driven\n");
  EXPECT_THAT(map("edit merge " + file + " 0 3").data,
              HasSubstr("edit 4: node 3 is node 0, turned by -14"));
  EXPECT_EQ(map("edit delete " + file + " kitchen").data, "edit 5: node 1 is deleted\n");
  EXPECT_THAT(map("check " + file).data, HasSubstr("room.hwm: ok, nodes 2, edges 1, pictures 2"));
  EXPECT_EQ(map("edit undo " + file).data, "undone edit 5: node 1 is deleted\n");
  EXPECT_THAT(map("edit journal " + file).data, HasSubstr("edit 5: node 1 is deleted (undone)\n"));
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(map("edit undo " + file).status, 0);
  }
  EXPECT_EQ(canonical(), before);
  expectRefused("edit undo " + file, "has no edit to undo");
}

TEST_F(MapCommand, RefusesEditsThatMakeNoSense)
{
  map("edit rename " + file + " 2 kitchen");
  expectRefused("edit rename " + file + " 1 kitchen", "is that of node 2");
  expectRefused("edit rename " + file + " 1 17", "the name \"17\" for node 1 is a number");
  expectRefused("edit delete " + file + " cellar", "has no node cellar");
  expectRefused("edit no-go " + file + " 0 2", "has no edge between node 0 and node 2");
  expectRefused("edit merge " + file + " 0 2", "nodes 0 and 2 do not look like one place");
  expectRefused("edit merge " + file + " 0 0 --force", "cannot be merged with itself");
  EXPECT_EQ(map("edit merge --force --turn 90 " + file + " 0 2").data,
            "edit 2: node 2 is node 0, turned by 90 degrees\n");
}

TEST_F(MapCommand, CheckNamesWhatIsDamaged)
{
  const std::string cut = folder / "cut.hwm";
  std::filesystem::copy_file(file, cut);
  std::filesystem::resize_file(cut, std::filesystem::file_size(cut) / 2);
  const ProgramRun run = map("check " + file + " " + cut);
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.data, HasSubstr("room.hwm: ok"));
  EXPECT_THAT(run.output, HasSubstr("cut.hwm"));
  expectRefused("check " + (folder / "none.hwm"), "there is no such file");
}

TEST_F(MapCommand, NodeTellsAllThatTheMapHoldsOfIt)
{
  map("edit rename " + file + " 3 kitchen");
  const std::string picture = folder / "kitchen.png";
  const std::string json = folder / "kitchen.json";
  const ProgramRun run =
      map("node kitchen --map " + file + " --picture " + picture + " --json " + json);
  EXPECT_EQ(run.status, 0) << run.output;
  EXPECT_THAT(run.data, HasSubstr("node 3 kitchen\n"));
  EXPECT_THAT(run.data, HasSubstr("panorama 720 x 160 pixels, -45 to +35 deg"));
  EXPECT_THAT(run.data, HasSubstr("neighbours 1\n  node 2: "));
  // Nodes 0 and 3 are one place.
  EXPECT_THAT(run.data, HasSubstr("looks most like 3\n  node 0: distance 0."));

  const nlohmann::json said = nlohmann::json::parse(fileText(json));
  EXPECT_EQ(said["node"], 3);
  EXPECT_EQ(said["name"], "kitchen");
  EXPECT_EQ(said["neighbours"].size(), 1U);
  EXPECT_EQ(said["alike"][0]["node"], 0);
  EXPECT_LT(said["alike"][0]["distance"], said["alike"][1]["distance"]);
  EXPECT_GT(said["alike"][0]["probability"], 0.9);

  const cv::Mat drawn = cv::imread(picture);
  EXPECT_EQ(drawn.cols, 1200);
  EXPECT_EQ(map("node 3 --map " + file + " --picture - --json " + json).data.substr(1, 3), "PNG");
  expectRefused("node 9 --map " + file, "has no node 9; ");
  expectRefused("node cellar --map " + file, "has no node cellar; ");
}

TEST_F(MapCommand, RenderDrawsAsWideAsAskedFor)
{
  const std::string picture = folder / "room.png";
  EXPECT_EQ(map("render " + file + " --width 800 -o " + picture).status, 0);
  EXPECT_EQ(cv::imread(picture).cols, 800);
}

TEST_F(MapCommand, TwoMapsBecomeOne)
{
  const std::string other = folder / "other.hwm";
  const std::string both = folder / "both.hwm";
  writeRoomMap(other, SyntheticRoom(3, 10.0, 7.0),
               {{1.45, 0.55, 1.0}, {3.4, 2.2, 0.3}, {-1.45, 0.05, -2.0}});
  const ProgramRun run = map("merge " + file + " " + other + " --out " + both);
  EXPECT_EQ(run.status, 0) << run.output;
  EXPECT_THAT(run.data, HasSubstr("other.hwm is node 1 of"));
  EXPECT_THAT(run.data, HasSubstr("node 1 of " + other + " is new: 5"));
  EXPECT_EQ(map("check " + both).status, 0);
  expectRefused("merge " + file + " " + other + " --out " + both, "exists already");

  const std::string elsewhere = folder / "elsewhere.hwm";
  writeRoomMap(elsewhere, SyntheticRoom(8, 10.0, 7.0), {{1.45, 0.55, 1.0}, {3.4, 2.2, 0.3}});
  expectRefused("merge " + file + " " + elsewhere + " --out " + (folder / "no.hwm"),
                "have no place in common for sure");
  const std::string strange = folder / "strange.hwm";
  writeRoomMap(strange, SyntheticRoom(3, 10.0, 7.0), {{1.45, 0.55, 1.0}}, "another camera");
  expectRefused("merge " + file + " " + strange + " --out " + (folder / "no.hwm"),
                "was made with camera");
}

} // namespace
} // namespace homeward
