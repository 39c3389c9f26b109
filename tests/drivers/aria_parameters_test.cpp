// SPDX-License-Identifier: GPL-3.0-or-later
#include "test_paths.h"

#include <homeward/core/angle.h>
#include <homeward/core/error.h>
#include <homeward/drivers/protocol/aria_parameters.h>

#include <fstream>
#include <gmock/gmock.h>
#include <sstream>

namespace homeward
{
namespace
{

using testing::HasSubstr;

const std::string kUnits = "AngleConvFactor 0.00153 ; radians\nDistConvFactor 0.46500\n"
                           "VelConvFactor 1.0\nRangeConvFactor 1.0\nDiffConvFactor 0.00340\n";

std::string refusal(const std::string &text)
{
  try {
    parseAriaParameters(text, "robot.p");
  }
  catch (const ConfigError &error) {
    return error.what();
  }
  return {};
}

TEST(AriaParameters, ReadsUnitsSonarsAndWhatTheRobotCanDo)
{
  const AriaParameters robot = parseAriaParameters(
      "; a comment\nSection General settings\nSubclass p3at ; type\nRobotWidth 505\n"
      "MaxVelocity 1200\nMaxRVelocity 300\nSwitchToBaudRate 38400\nLaserIgnore   ; none\n" +
          kUnits + "SonarUnit 1 193 119 50\nSonarUnit 0 147 136 90\n",
      "robot.p");
  EXPECT_EQ(robot.subclass, "p3at");
  EXPECT_DOUBLE_EQ(robot.units.distance, 0.465e-3);
  EXPECT_DOUBLE_EQ(robot.units.angle, 0.00153);
  EXPECT_NEAR(robot.units.turnPerDiff, 3.4, 1e-12);
  EXPECT_DOUBLE_EQ(robot.width, 0.505);
  EXPECT_DOUBLE_EQ(robot.maxSpeed, 1.2);
  EXPECT_NEAR(robot.maxTurnRate, radians(300.0), 1e-12);
  EXPECT_EQ(robot.switchToBaud, 38400);
  ASSERT_EQ(robot.sonars.size(), 2U);
  EXPECT_DOUBLE_EQ(robot.sonars[0].x, 0.147);
  EXPECT_NEAR(robot.sonars[1].bearing, radians(50.0), 1e-12);
}

TEST(AriaParameters, RefusalsNameFileLineAndKey)
{
  EXPECT_THAT(refusal(""), HasSubstr("robot.p: 'DistConvFactor' is missing"));
  EXPECT_THAT(refusal(kUnits + "SonarUnit 0 a b c\n"), HasSubstr("robot.p, line 6: 'SonarUnit'"));
  EXPECT_THAT(refusal(kUnits + "SonarUnit 64 1 2 3\n"), HasSubstr("'SonarUnit' is '64 1 2 3'"));
  EXPECT_THAT(refusal(kUnits + "SonarUnit -1 1 2 3\n"), HasSubstr("line 6"));
  EXPECT_THAT(refusal("DistConvFactor far\n"), HasSubstr("line 1: 'DistConvFactor' is 'far'"));
  EXPECT_THAT(refusal("DistConvFactor -1\n"), HasSubstr("not positive"));
}

TEST(AriaParameters, ARealFileSaysWhatThisProjectKnows)
{
  HOMEWARD_NEEDS_OUTSIDE_DATA("pioneer/p3at.p");
  for (const std::string subclass : {"p3at", "p3at-sh"}) {
    const auto file = outsideDataDir() / "pioneer" / (subclass + ".p");
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    const AriaParameters robot = parseAriaParameters(text.str(), file.string());
    const ArcosUnits units = *ArcosUnits::of(subclass);
    EXPECT_EQ(robot.subclass, subclass);
    EXPECT_DOUBLE_EQ(robot.units.distance, units.distance);
    EXPECT_NEAR(robot.units.angle, units.angle, 5e-6); // the file has five digits
    EXPECT_NEAR(robot.units.turnPerDiff, units.turnPerDiff, 1e-9);
    EXPECT_EQ(robot.sonars.size(), 16U);
  }
}

} // namespace
} // namespace homeward
