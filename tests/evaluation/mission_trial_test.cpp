// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/angle.h>
#include <homeward/core/error.h>
#include <homeward/evaluation/mission_summary.h>
#include <homeward/evaluation/mission_trial_json.h>

#include <gtest/gtest.h>

namespace homeward
{
namespace
{

GoalDrive ended(Outcome outcome, double error, std::optional<FirstPlace> first = std::nullopt)
{
  GoalDrive drive;
  drive.goal = NodeId{3};
  drive.outcome = outcome;
  drive.reason = "because";
  drive.error = error;
  drive.headingError = radians(2.0);
  drive.seconds = 30.0;
  drive.first = first;
  return drive;
}

MissionTrial trialOf(std::uint64_t seed, Outcome outcome)
{
  MissionTrial trial;
  trial.world = "room";
  trial.seed = seed;
  trial.outcome = outcome;
  trial.reason = "a \"reason\"";
  trial.nodes = 12;
  trial.edges = 17;
  trial.openDirections = 2;
  trial.homings = {9, 8};
  trial.collisions = 1;
  trial.unseenContacts = 4;
  trial.distance = 100.0 / 3.0 * static_cast<double>(seed);
  trial.seconds = 200.0;
  trial.wallSeconds = 7.0;
  trial.truth = {0.9, 1, 2};
  trial.coverage = {{6.1, 0.3}, {20.5, 0.9}};
  trial.oracle = {{{0.5, -1.0}, {2.0, 1.0 / 3.0}}, 10.0, 0.99};
  trial.oracleSeconds = 20.0;
  trial.allWallSeconds = 8.0;
  GoalDrive goal = ended(Outcome::Done, 0.02, FirstPlace{NodeId{1}, 0.1, 2.0});
  goal.from = NodeId{1};
  goal.start = {1.0, -2.0, 1.0 / 7.0};
  goal.distance = 5.0;
  goal.collisions = 1;
  goal.unseenContacts = 2;
  trial.goals = {goal};
  trial.kidnappings = {ended(Outcome::Failed, 4.0), ended(Outcome::Stopped, 3.0)};
  trial.barred = {{EdgeId{5}, 2.5, goal, false, {}},
                  {EdgeId{6}, 3.0, ended(Outcome::Failed, 2.0), true, {40.25, 11.0}},
                  {EdgeId{7}, 1.0, ended(Outcome::Failed, 2.0), false, {90.0}}};
  return trial;
}

TEST(MissionTrial, comesBackFromItsJsonToTheLastDigit)
{
  const MissionTrial trial = trialOf(1, Outcome::Stopped);
  const MissionTrial read = parseMissionTrial(missionTrialJson(trial));
  EXPECT_EQ(missionTrialJson(read), missionTrialJson(trial));
  EXPECT_EQ(read.world, "room");
  EXPECT_EQ(read.outcome, Outcome::Stopped);
  EXPECT_EQ(read.reason, trial.reason);
  EXPECT_EQ(read.homings.homingsTried, 9);
  EXPECT_EQ(read.homings.homingsArrived, 8);
  EXPECT_EQ(read.distance, trial.distance);
  EXPECT_EQ(read.truth.falseEdges, 1);
  EXPECT_EQ(read.truth.duplicateNodes, 2);
  EXPECT_EQ(read.coverage.back().seconds, 20.5);
  EXPECT_EQ(read.oracle.places.back(), trial.oracle.places.back());
  EXPECT_EQ(read.goals.front().from, NodeId{1});
  EXPECT_EQ(read.goals.front().start.heading, 1.0 / 7.0);
  EXPECT_EQ(read.goals.front().first.value().seconds, 2.0);
  EXPECT_FALSE(read.kidnappings.front().from);
  EXPECT_FALSE(read.kidnappings.front().first);
  EXPECT_EQ(read.kidnappings.back().outcome, Outcome::Stopped);
  EXPECT_EQ(read.barred.front().edge, EdgeId{5});
  EXPECT_EQ(read.barred.front().barrierWidth, 2.5);
  EXPECT_EQ(read.barred.front().drive.from, NodeId{1});
  EXPECT_TRUE(read.barred.at(1).noWayLeft);
  EXPECT_EQ(read.barred.at(1).meetings, trial.barred.at(1).meetings);
}

TEST(MissionTrial, jsonOfBeforeThereWereBarriersIsRead)
{
  MissionTrial trial = trialOf(1, Outcome::Done);
  trial.barred.clear();
  std::string text = missionTrialJson(trial);
  const std::string barred = "\"barred\": [],";
  text.erase(text.find(barred), barred.size());
  EXPECT_EQ(missionTrialJson(parseMissionTrial(text)), missionTrialJson(trial));
}

TEST(MissionTrial, jsonThatIsNoneIsRefused)
{
  std::string text = missionTrialJson(trialOf(1, Outcome::Done));
  EXPECT_THROW(parseMissionTrial(text.substr(0, text.size() / 2)), ConfigError);
  EXPECT_THROW(parseMissionTrial("{}"), ConfigError);
  EXPECT_THROW(parseMissionTrial("[1]"), ConfigError);
  text.replace(text.find("\"done\""), 6, "\"dead\"");
  EXPECT_THROW(parseMissionTrial(text), ConfigError);
}

TEST(MissionTrial, arrivedIsWhoSaysSoAndIsThere)
{
  EXPECT_TRUE(ended(Outcome::Done, 0.29).arrived());
  EXPECT_FALSE(ended(Outcome::Done, 0.31).arrived());
  EXPECT_FALSE(ended(Outcome::Failed, 0.01).arrived());
  EXPECT_FALSE(ended(Outcome::Stopped, 0.01).arrived());
}

TEST(MissionSummary, countsDrivesAndWhatTheyBelieved)
{
  const GoalSummary summary = summariseDrives(
      {ended(Outcome::Done, 0.1, FirstPlace{NodeId{0}, 0.1, 2.0}),
       ended(Outcome::Done, 0.2, FirstPlace{NodeId{0}, 3.0, 50.0}), // found out later
       ended(Outcome::Done, 5.0, FirstPlace{NodeId{0}, 0.2, 4.0}), ended(Outcome::Failed, 4.0)});
  EXPECT_EQ(summary.arrived.successes, 2U);
  EXPECT_EQ(summary.arrived.trials, 4U);
  EXPECT_EQ(summary.wronglyArrived, 1U);
  EXPECT_EQ(summary.medianError, 0.2);
  EXPECT_NEAR(summary.medianHeadingDeg, 2.0, 1e-9);
  EXPECT_EQ(summary.firstRight.successes, 2U);
  EXPECT_EQ(summary.firstRight.trials, 4U);
  EXPECT_EQ(summary.firstWrong, 1U);
  EXPECT_EQ(summary.neverKnew, 1U);
  EXPECT_EQ(summary.secondsToKnow.value, 3.0);
}

TEST(MissionSummary, addsTrialsUp)
{
  MissionTrial covered = trialOf(2, Outcome::Done);
  covered.truth = {1.0, 0, 0};
  const MissionSummary summary = summariseTrials({trialOf(1, Outcome::Stopped), covered});
  EXPECT_EQ(summary.finished.successes, 1U);
  EXPECT_EQ(summary.finished.trials, 2U);
  EXPECT_NEAR(summary.coverage.value, 0.95, 1e-12);
  EXPECT_LE(summary.coverage.interval.value().high, 1.0) << "no more than all of the floor";
  EXPECT_EQ(summary.leastCoverage, 0.9);
  EXPECT_EQ(summary.falseEdges, 1);
  EXPECT_EQ(summary.duplicateNodes, 2);
  EXPECT_EQ(summary.collisions, 2);
  EXPECT_EQ(summary.unseenContacts, 8);
  EXPECT_EQ(summary.homings.successes, 16U);
  EXPECT_EQ(summary.homings.trials, 18U);
  EXPECT_NEAR(summary.distanceFactor.value, 5.0, 1e-9); // of 3.3 and 6.7
  EXPECT_NEAR(summary.secondsFactor.value, 10.0, 1e-9);
  EXPECT_EQ(summary.goals.arrived.successes, 2U);
  EXPECT_EQ(summary.goals.collisions, 2);
  EXPECT_EQ(summary.kidnappings.neverKnew, 4U);
}

TEST(MissionSummary, ofBarriersKeepsTheLongestMeeting)
{
  const BarredSummary summary = summariseBarred(trialOf(1, Outcome::Done).barred);
  EXPECT_EQ(summary.right.successes, 2U) << "one arrived, one rightly said that it cannot";
  EXPECT_EQ(summary.right.trials, 3U);
  EXPECT_EQ(summary.noWayLeft, 1U);
  EXPECT_EQ(summary.meetings, 3U);
  EXPECT_EQ(summary.longestMeeting, 90.0);
  EXPECT_EQ(summary.collisions, 1);
  EXPECT_EQ(summary.unseenContacts, 2);
  EXPECT_EQ(summariseTrials({trialOf(1, Outcome::Done), trialOf(2, Outcome::Done)}).barred.meetings,
            6U);
  EXPECT_EQ(summariseBarred({}).longestMeeting, 0.0);
}

TEST(MissionSummary, noAmountIsLessThanNothing)
{
  MissionTrial little = trialOf(1, Outcome::Done);
  MissionTrial much = trialOf(2, Outcome::Done);
  little.nodes = 1;
  much.nodes = 100;
  little.distance = little.seconds = little.oracle.length = 1.0;
  much.distance = much.seconds = 1000.0;
  little.goals.front().seconds = little.goals.front().first->seconds = 1.0;
  much.goals.front().seconds = much.goals.front().first->seconds = 1000.0;
  const MissionSummary summary = summariseTrials({little, much});
  for (const Mean &mean : {summary.nodes, summary.distance, summary.seconds, summary.oracleLength,
                           summary.distanceFactor, summary.secondsFactor, summary.goals.seconds,
                           summary.goals.secondsToKnow}) {
    EXPECT_EQ(mean.interval.value().low, 0.0);
    EXPECT_GT(mean.interval.value().high, mean.value);
  }
}

TEST(MissionSummary, aStartThatCoversAllHasNoOracleToCompareWith)
{
  MissionTrial trial = trialOf(1, Outcome::Done);
  trial.oracle = {{{0.0, 0.0}}, 0.0, 1.0};
  trial.oracleSeconds = 0.0;
  EXPECT_EQ(summariseTrials({trial}).distanceFactor.count, 0U);
  EXPECT_EQ(summariseTrials({}).finished.trials, 0U);
}

} // namespace
} // namespace homeward
