// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/angle.h>
#include <homeward/core/error.h>
#include <homeward/robot/robot_description.h>

#include "test_paths.h"

#include <fstream>
#include <gmock/gmock.h>
#include <sstream>

namespace homeward
{
namespace
{

using testing::AllOf;
using testing::DoubleNear;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::string wheel(const std::string &name, double x, double y, double radius = 0.1)
{
  std::ostringstream text;
  text << "<link name='" << name << "'><collision><origin rpy='1.5707963267948966 0 0'/><geometry>"
       << "<cylinder radius='" << radius << "' length='0.08'/></geometry></collision></link>"
       << "<joint name='" << name << "_wheel_joint' type='continuous'><parent link='base_link'/>"
       << "<child link='" << name << "'/><origin xyz='" << x << " " << y << " 0.02'/></joint>";
  return text.str();
}

std::string frame(const std::string &name, const std::string &xyz, const std::string &rpy = "0 0 0")
{
  return "<link name='" + name + "'/><joint name='" + name +
         "_joint' type='fixed'><parent link='base_link'/><child link='" + name +
         "'/><origin xyz='" + xyz + "' rpy='" + rpy + "'/></joint>";
}

/** base_link stands 0.08 m above the floor and 0.05 m ahead of the middle of the wheels. */
const std::string kBody = "<link name='base_link'><collision><origin xyz='-0.05 0 0.15'/><geometry>"
                          "<box size='0.4 0.3 0.2'/></geometry></collision></link>";
const std::string kWheels = wheel("left", -0.05, 0.2) + wheel("right", -0.05, -0.2);
const std::string kLaser = frame("laser", "0.11 0 0.25");
const std::string kMirror = frame("mirror", "-0.05 0 0.82");

std::string robot(const std::string &inner)
{
  return "<?xml version='1.0'?><robot name='cart'>" + inner + "</robot>";
}

/** The refusal of a document; empty when it is accepted. */
std::string refusal(const std::string &xml)
{
  try {
    parseRobotDescription(xml, "cart.urdf");
  }
  catch (const ConfigError &error) {
    return error.what();
  }
  return {};
}

TEST(RobotDescription, FrameStandsOnTheFloorUnderTheMiddleOfTheWheels)
{
  const RobotDescription cart =
      parseRobotDescription(robot(kBody + kWheels + kLaser + kMirror), "");
  EXPECT_EQ(cart.name, "cart");
  EXPECT_DOUBLE_EQ(cart.wheelRadius, 0.1);
  EXPECT_DOUBLE_EQ(cart.track, 0.4);
  EXPECT_TRUE(cart.rMl.translation().isApprox(Eigen::Vector3d(0.16, 0.0, 0.33), 1e-12));
  EXPECT_TRUE(cart.rMp.translation().isApprox(Eigen::Vector3d(0.0, 0.0, 0.9), 1e-12));
}

TEST(RobotDescription, BodyHasOneBoxPerCollisionAndTheFootprintIsAroundThem)
{
  const RobotDescription cart =
      parseRobotDescription(robot(kBody + kWheels + kLaser + kMirror), "");
  ASSERT_EQ(cart.body.size(), 3U);
  const BodyPart around = cart.footprint();
  EXPECT_NEAR(around.xMin, -0.2, 1e-12);
  EXPECT_NEAR(around.xMax, 0.2, 1e-12);
  EXPECT_NEAR(around.yMin, -0.24, 1e-12); // wheels: 0.2 plus half their width
  EXPECT_NEAR(around.yMax, 0.24, 1e-12);
  EXPECT_NEAR(around.zMin, 0.0, 1e-12);
  EXPECT_NEAR(around.zMax, 0.33, 1e-12);
}

TEST(RobotDescription, BoxesFollowTurnedShapes)
{
  const std::string turned =
      "<link name='base_link'><collision><origin rpy='0 0 1.5707963267948966'/><geometry>"
      "<box size='0.4 0.3 0.2'/></geometry></collision><collision><origin rpy='0 "
      "1.5707963267948966 "
      "0' xyz='0 0 1'/><geometry><cylinder radius='0.05' length='0.6'/></geometry></collision>"
      "<collision><origin xyz='0 0 2'/><geometry><sphere "
      "radius='0.07'/></geometry></collision></link>";
  const RobotDescription cart =
      parseRobotDescription(robot(turned + kWheels + kLaser + kMirror), "");
  const auto sizes = [&](std::size_t i) {
    const BodyPart &part = cart.body.at(i);
    return std::vector{part.xMax - part.xMin, part.yMax - part.yMin, part.zMax - part.zMin};
  };
  const auto near = [](double x, double y, double z) {
    return testing::ElementsAre(DoubleNear(x, 1e-9), DoubleNear(y, 1e-9), DoubleNear(z, 1e-9));
  };
  EXPECT_THAT(sizes(0), near(0.3, 0.4, 0.2));
  EXPECT_THAT(sizes(1), near(0.6, 0.1, 0.1));
  EXPECT_THAT(sizes(2), near(0.14, 0.14, 0.14));
}

TEST(RobotDescription, SonarsComeInTheOrderOfTheirNumbers)
{
  const std::string sonars = frame("sonar_10", "0.1 0 0", "0 0 -1") + frame("sonar_2", "0.2 0 0") +
                             frame("sonar_dome", "0.3 0 0");
  const RobotDescription cart =
      parseRobotDescription(robot(kBody + kWheels + kLaser + kMirror + sonars), "");
  ASSERT_EQ(cart.sonars.size(), 2U);
  EXPECT_NEAR(cart.sonars[0].x, 0.25, 1e-12);
  EXPECT_NEAR(cart.sonars[0].bearing, 0.0, 1e-12);
  EXPECT_NEAR(cart.sonars[1].bearing, -1.0, 1e-12);
  EXPECT_NEAR(cart.sonars[1].z, 0.08, 1e-12);
}

TEST(RobotDescription, RefusalsNameFileAndCulpritInOneLine)
{
  const std::string mesh = "<link name='base_link'><collision><geometry><mesh filename='a.stl'/>"
                           "</geometry></collision></link>";
  const std::string arm = "<link name='arm'/><joint name='elbow' type='revolute'><parent "
                          "link='base_link'/><child link='arm'/><limit effort='1' velocity='1'/>"
                          "</joint>";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {robot(kBody + kWheels + kMirror), "'laser'"},
      {robot(kBody + kWheels + kLaser), "'mirror'"},
      {"this is not XML", "not a URDF document"},
      {"", "not a URDF document"},
      {"<sdf/>", "not a URDF document"},
      {robot("<link name='base_link'/>" + kLaser + kMirror), "no <collision>"},
      {robot(kBody + kLaser + kMirror), "no driven wheels"},
      {robot(kBody + wheel("left", 0, 0.2) + kLaser + kMirror), "on the right"},
      {robot(kBody + kWheels + wheel("odd", 0, 0.2, 0.2) + kLaser + kMirror), "another radius"},
      {robot(mesh + kWheels + kLaser + kMirror), "'base_link': a <collision> mesh"},
      {robot(kBody + kWheels + kLaser + kMirror + arm), "'elbow'"},
  };
  for (const auto &[xml, culprit] : cases) {
    EXPECT_THAT(refusal(xml),
                AllOf(StartsWith("cart.urdf: "), HasSubstr(culprit), Not(HasSubstr("\n"))))
        << xml;
  }
}

TEST(RobotDescription, ParserPrintsNothing)
{
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  refusal("this is not XML");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(RobotDescription, FootprintOfNoBodyIsACallersError)
{
  EXPECT_THROW(RobotDescription{}.footprint(), LogicError);
}

TEST(RobotDescription, EveryShippedRobotIsRead)
{
  std::size_t count = 0;
  for (const auto &entry : std::filesystem::directory_iterator(dataDir() / "robots")) {
    if (entry.path().extension() != ".urdf") {
      continue;
    }
    std::ostringstream text;
    text << std::ifstream(entry.path()).rdbuf();
    const RobotDescription description =
        parseRobotDescription(text.str(), entry.path().filename().string());
    EXPECT_GT(description.footprint().zMax, 0.1) << entry.path();
    EXPECT_GT(description.rMp.translation().z(), description.rMl.translation().z()) << entry.path();
    ++count;
  }
  EXPECT_GT(count, 0U) << "no robots in " << dataDir();
}

} // namespace
} // namespace homeward
