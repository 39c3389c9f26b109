// SPDX-License-Identifier: GPL-3.0-or-later
#include "ideal_base.h"

#include <homeward/servo/feature_heading.h>
#include <homeward/visp_base/base_robot.h>
#include <homeward/visp_base/visp_base.h>

#include <gtest/gtest.h>
#include <visp3/robot/vpSimulatorPioneer.h>
#include <visp3/vs/vpServo.h>

namespace
{

// As a reader of the README has it: outside our namespace.
TEST(VispBaseReadme, ExampleTurnsTheRobotTowardsTheHeading)
{
  homeward::IdealBase mobileBase;
  homeward::HandClock clock;
  const vpHomogeneousMatrix cMe;
  homeward::FeatureHeading heading;
  homeward::FeatureHeading wanted;
  heading.set(-0.4); // it looks to the right of home
  wanted.set(0.0);
  vpServo task;
  task.setServo(vpServo::EYEINHAND_L_cVe_eJe);
  task.setInteractionMatrixType(vpServo::CURRENT);
  task.setLambda(0.5);
  task.addFeature(heading, wanted);

#include "readme_example.inc"

  EXPECT_NEAR(mobileBase.told.velocity.v, 0.0, 1e-9);
  EXPECT_NEAR(mobileBase.told.velocity.w, 0.5 * 0.4, 1e-9);
  clock.sleepUntil(clock.now() + homeward::fromSeconds(0.04)); // vpSimulatorPioneer's period
  EXPECT_NEAR(base.state().velocity.v, 0.1, 1e-6);
}

} // namespace
