// SPDX-License-Identifier: GPL-3.0-or-later
#include "test_paths.h"
#include "test_robot.h"

#include <homeward/core/error.h>
#include <homeward/evaluation/arrival_trials.h>

#include <gtest/gtest.h>

namespace homeward
{
namespace
{

ArrivalRun ended(HomingEnd outcome, double offMetres, double offDegrees)
{
  ArrivalRun run;
  run.home = {1.0, 2.0, 3.0};
  run.end = {1.0 + offMetres, 2.0, wrapAngle(3.0 + radians(offDegrees))};
  run.outcome = outcome;
  run.seconds = 10.0;
  return run;
}

TEST(ArrivalTrials, ArrivedIsWhoSaysSoAndIsThere)
{
  const ArrivalScore score =
      scoreArrivals({ended(HomingEnd::Arrived, 0.02, 1.0), ended(HomingEnd::Arrived, 0.04, -20.0),
                     ended(HomingEnd::Arrived, -0.06, 3.0), ended(HomingEnd::Arrived, 0.8, 0.0),
                     ended(HomingEnd::Lost, 0.01, 0.0)});
  EXPECT_EQ(score.runs, 5U);
  EXPECT_EQ(score.arrived, 3U);
  EXPECT_EQ(score.wronglyArrived, 1U);
  EXPECT_NEAR(score.medianError, 0.04, 1e-12);
  EXPECT_NEAR(score.medianHeadingDeg, 3.0, 1e-9);
}

TEST(ArrivalTrials, DrivesHomeInTheLaboratory)
{
  const auto scene = std::make_shared<const Scene>(loadScene(dataDir() / "worlds/lab.sdf"));
  ArrivalOptions options;
  options.runs = 1;
  const std::vector<ArrivalRun> runs =
      driveHome(scene, testRobot(), testCamera(), PilotOptions(), options);
  ASSERT_EQ(runs.size(), 1U);
  for (const ArrivalRun &run : runs) {
    EXPECT_TRUE(run.arrived()) << run.error();
    EXPECT_GT((run.start.translation() - run.home.translation()).norm(), 0.29);
    EXPECT_LT((run.way.front() - run.start.translation()).norm(), 0.1);
    EXPECT_LT((run.way.back() - run.end.translation()).norm(), 0.05);
  }
}

TEST(ArrivalTrials, AWorldWithoutSuchPlacesIsRefused)
{
  const auto scene = std::make_shared<const Scene>(loadScene(dataDir() / "worlds/lab.sdf"));
  ArrivalOptions options;
  options.runs = 3;
  options.nearest = 90.0;
  options.farthest = 91.0;
  EXPECT_THROW(driveHome(scene, testRobot(), testCamera(), PilotOptions(), options), ConfigError);
}

} // namespace
} // namespace homeward
