// SPDX-License-Identifier: GPL-3.0-or-later
#include "../contract/test_room.h"
#include "test_robot.h"

#include <homeward/sim/sonar_model.h>

#include <cmath>
#include <gtest/gtest.h>

namespace homeward
{
namespace
{

RobotDescription oneSonarAhead()
{
  RobotDescription robot = testRobot();
  robot.sonars = {{0.2, 0.0, 0.25, 0.0}};
  return robot;
}

SonarModel sonarIn(Scene scene, const RobotDescription &robot)
{
  const SolidWorld world{
      std::make_shared<RayCaster>(share(std::move(scene)), RayCaster::Layer::Collision)};
  return {world, robot, 1};
}

TEST(Sonar, hearsAWallAheadAndEveryTransducerAnswers)
{
  const RobotDescription robot = testRobot();
  const auto echoes = sonarIn(makeRoom(4.0F, 4.0F), robot).measure({2.0, 2.0, 0.0});
  ASSERT_EQ(echoes.size(), robot.sonars.size());
  for (std::size_t i = 0; i < echoes.size(); ++i) {
    EXPECT_EQ(echoes[i].bearing, robot.sonars[i].bearing);
    EXPECT_GT(echoes[i].range, 1.5);
    EXPECT_LT(echoes[i].range, 2.3);
  }
  const auto ahead = sonarIn(makeRoom(4.0F, 4.0F), oneSonarAhead()).measure({2.5, 2.0, 0.0});
  EXPECT_NEAR(ahead[0].range, 4.0 - 2.7, 0.05);
}

TEST(Sonar, hearsNothingBeyondItsRangeAndNoEchoOfTheFloor)
{
  const auto echoes = sonarIn(makeRoom(20.0F, 20.0F), oneSonarAhead()).measure({10.0, 10.0, 0.0});
  EXPECT_TRUE(std::isnan(echoes[0].range));
}

TEST(Sonar, coneSeesWhatTheLaserPlaneMisses)
{
  // A seat at 40 to 44 cm, above the laser's plane; the sonar's cone rises to it.
  Scene scene = makeRoom(20.0F, 20.0F);
  addBox(scene, {11.0F, 9.5F, 0.40F}, {12.0F, 10.5F, 0.44F});
  const auto echoes = sonarIn(std::move(scene), oneSonarAhead()).measure({10.0, 10.0, 0.0});
  EXPECT_NEAR(echoes[0].range, 0.86, 0.1);
}

} // namespace
} // namespace homeward
