// SPDX-License-Identifier: GPL-3.0-or-later
#include "program.h"
#include "test_paths.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace homeward
{
namespace
{

/** One clear line that names what is wrong, exit status 1 or 2, no file left behind. */
void expectRefusal(const ProgramRun &run, const std::string &named)
{
  EXPECT_THAT(run.status, testing::AnyOf(1, 2)) << run.output;
  EXPECT_THAT(run.output, testing::HasSubstr(named));
  EXPECT_EQ(std::count(run.output.begin(), run.output.end(), '\n'), 1) << run.output;
}

struct BadInput : testing::Test
{
  std::string write(const std::string &name, const std::string &text) const
  {
    const std::string file = folder / name;
    std::ofstream(file) << text;
    return file;
  }

  std::string explore(const std::string &more) const
  {
    return "explore --map " + map + " --max-time 1 " + more;
  }

  void expectNoMap() const
  {
    EXPECT_FALSE(std::filesystem::exists(map));
    EXPECT_FALSE(std::filesystem::exists(map + ".part"));
  }

  Folder folder;
  std::string map = folder / "map.hwm";
};

TEST_F(BadInput, MissingWorld)
{
  expectRefusal(runProgram(explore("--world nowhere.sdf")), "nowhere.sdf");
  expectNoMap();
}

TEST_F(BadInput, BrokenWorld)
{
  expectRefusal(runProgram(explore("--world " + write("bad.sdf", "<sdf><world"))), "bad.sdf");
  expectNoMap();
}

TEST_F(BadInput, StartInAWall)
{
  expectRefusal(runProgram(explore("--start 500,0,0")), "500");
  expectRefusal(runProgram(explore("--start 1,2")), "1,2");
  expectNoMap();
}

TEST_F(BadInput, UnknownLight)
{
  expectRefusal(runProgram(explore("--light noon")), "noon");
  expectNoMap();
}

TEST_F(BadInput, BrokenRigRobotAndCamera)
{
  const std::string camera = (dataDir() / "cameras/sim_nominal.yaml").string();
  const std::string robot = (dataDir() / "robots/pioneer3at.urdf").string();
  expectRefusal(runProgram(explore("--rig " + write("rig.yaml", "robot: ["))), "rig.yaml");
  const std::string noRobot = write("a.yaml", "robot: none.urdf\ncamera: " + camera + "\n");
  expectRefusal(runProgram(explore("--rig " + noRobot)), "none.urdf");
  const std::string badUrdf = write("bad.urdf", "<robot");
  const std::string rig = write("b.yaml", "robot: " + badUrdf + "\ncamera: " + camera + "\n");
  expectRefusal(runProgram(explore("--rig " + rig)), "bad.urdf");
  const std::string badCamera = write("camera.yaml", "model: pinhole\n");
  const std::string third = write("c.yaml", "robot: " + robot + "\ncamera: " + badCamera + "\n");
  expectRefusal(runProgram(explore("--rig " + third)), "camera.yaml");
  expectNoMap();
}

TEST_F(BadInput, MapThatExistsOrCannotBeWritten)
{
  const std::string taken = write("taken.hwm", "mine");
  expectRefusal(runProgram("explore --max-time 1 --map " + taken), "taken.hwm");
  EXPECT_EQ(fileText(taken), "mine");
  expectRefusal(runProgram("explore --max-time 1 --map " + folder / "no/such/folder.hwm"),
                "folder.hwm");
}

TEST_F(BadInput, FilesThatAreNoMap)
{
  expectRefusal(runProgram("map info " + folder / "none.hwm"), "none.hwm");
  expectRefusal(runProgram("map info " + write("text.hwm", "not a map at all")), "text.hwm");
  expectRefusal(runProgram("navigate --to 0 --map " + folder / "none.hwm"), "none.hwm");
}

TEST_F(BadInput, UnknownNode)
{
  ASSERT_EQ(runProgram("explore --max-time 30 --map " + map).status, 1); // stopped in mid-run
  expectRefusal(runProgram("navigate --map " + map + " --to 99"), "99");
}

TEST_F(BadInput, LogsAndPictures)
{
  expectRefusal(runProgram("scan " + folder / "none.log"), "none.log");
  expectRefusal(runProgram("scan " + write("text.log", "hello\n")), "text.log");
  const std::string camera = (dataDir() / "cameras/sim_nominal.yaml").string();
  expectRefusal(runProgram("unwrap none.png --camera " + camera), "none.png");
  expectRefusal(runProgram("unwrap none.png --camera none.yaml"), "none.yaml");
}

TEST_F(BadInput, FullDisk)
{
  if (!std::filesystem::exists("/dev/full")) {
    GTEST_SKIP() << "no /dev/full here";
  }
  const std::string log = (dataDir() / "samples/sample.log.gz").string();
  expectRefusal(runProgram("scan " + log + " --json /dev/full"), "/dev/full");
}

TEST_F(BadInput, DiskThatFillsUpDuringARunKeepsTheMap)
{
  // No file may grow beyond 200 blocks of 1 KB: three nodes or so.
  const ProgramRun run = runProgram("explore --max-time 300 --map " + map, "ulimit -f 200; ");
  EXPECT_EQ(run.status, 1) << run.output;
  EXPECT_THAT(run.output, testing::ContainsRegex("\nhomeward: map [^\n]*map.hwm [^\n]*\n$"));
  const ProgramRun info = runProgram("map info " + map);
  EXPECT_EQ(info.status, 0) << info.output;
  EXPECT_THAT(info.output, testing::HasSubstr("nodes "));
}

} // namespace
} // namespace homeward
