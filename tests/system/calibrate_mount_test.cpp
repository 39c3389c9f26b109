// SPDX-License-Identifier: GPL-3.0-or-later
#include "program.h"
#include "synthetic_room.h"
#include "test_paths.h"

#include <homeward/dataset/data_set.h>
#include <homeward/robot/robot_description.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace homeward
{
namespace
{

using testing::HasSubstr;

/** Writes what a camera at rMp sees during a full turn and a straight line of some length. */
void writeDrive(const std::string &folder, const Pose2 &rMp, double way)
{
  const SyntheticRoom room(3, 7.0, 5.0);
  const PanoramaGeometry geometry;
  DataSet set(layoutOf(geometry), {geometry.width, geometry.height});
  const auto take = [&](const Pose2 &oMr) {
    std::string name = "view";
    name.append(std::to_string(set.size())).append(".png");
    set.add({name, oMr, "day"}, room.view(oMr * rMp).image);
  };
  for (int i = 0; i < 36; ++i) {
    take({-0.8, 0.3, wrapAngle(radians(10.0 * i))});
  }
  for (double along = 0.0; along < way; along += 0.1) {
    take({-0.8 + along, 0.3, 0.0});
  }
  set.write(folder);
}

std::string robotFile()
{
  return (dataDir() / "robots/pioneer3at.urdf").string();
}

TEST(CalibrateMount, putsTheMirrorWhereItIsAndLeavesTheRest)
{
  const Folder folder;
  writeDrive(folder / "drive", {0.2, -0.04, radians(30.0)}, 1.2);
  const std::string mounted = folder / "mounted.urdf";
  const ProgramRun run = runProgram("mount " + (folder / "drive") + " --robot " + robotFile() +
                                    " -o " + mounted + " --json -");
  ASSERT_EQ(run.status, 0) << run.output;
  const auto json = nlohmann::json::parse(run.data);
  EXPECT_NEAR(json["parameters"]["yaw_deg"]["value"].get<double>(), 30.0, 0.3);
  EXPECT_GT(json["parameters"]["x_m"]["sigma"].get<double>(), 0.0);
  const RobotDescription before = parseRobotDescription(fileText(robotFile()), robotFile());
  const RobotDescription after = parseRobotDescription(fileText(mounted), mounted);
  EXPECT_NEAR(after.rMp.translation().x(), 0.2, 0.01);
  EXPECT_NEAR(after.rMp.translation().y(), -0.04, 0.01);
  EXPECT_DOUBLE_EQ(after.rMp.translation().z(), before.rMp.translation().z());
  EXPECT_NEAR(std::atan2(after.rMp.linear()(1, 0), after.rMp.linear()(0, 0)), radians(30.0),
              radians(0.3));
  EXPECT_EQ(after.body.size(), before.body.size());
  EXPECT_THAT(fileText(mounted), HasSubstr("A Pioneer 3-AT with a SICK LMS-200 ahead"));
}

TEST(CalibrateMount, saysWhatToDriveAndWritesNothing)
{
  const Folder folder;
  writeDrive(folder / "drive", {}, 0.15);
  const std::string mounted = folder / "mounted.urdf";
  const ProgramRun run =
      runProgram("mount " + (folder / "drive") + " --robot " + robotFile() + " -o " + mounted);
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.output, HasSubstr("straight line of 0.5 m"));
  EXPECT_FALSE(std::filesystem::exists(mounted));
}

TEST(CalibrateMount, refusesARobotWithoutAMirror)
{
  const Folder folder;
  writeDrive(folder / "drive", {}, 1.0);
  const std::string robot = folder / "bare.urdf";
  const std::string options = "mount " + (folder / "drive") + " -o x.urdf --robot " + robot;
  std::ofstream(robot) << "<robot name='bare'><link name='base_link'/></robot>";
  EXPECT_THAT(runProgram(options).output, HasSubstr("no joint leads to a link mirror"));
  std::ofstream(robot) << "no robot";
  EXPECT_THAT(runProgram(options).output, HasSubstr("is no URDF document"));
  EXPECT_EQ(runProgram("mount nowhere --robot a -o b").status, 2);
}

} // namespace
} // namespace homeward
