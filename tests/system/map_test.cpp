// SPDX-License-Identifier: GPL-3.0-or-later
#include "program.h"
#include "room_map.h"

#include <gmock/gmock.h>

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
