// SPDX-License-Identifier: GPL-3.0-or-later
#include "synthetic_room.h"

#include <homeward/core/error.h>
#include <homeward/evaluation/homing_run.h>

#include <gmock/gmock.h>

#include <set>

namespace homeward
{
namespace
{

const Sees kSeesAll = [](const Eigen::Vector2d &, const Eigen::Vector2d &) { return true; };

/** Places on a square grid round the origin in turning headings, `half` on each side of it. */
std::vector<Pose2> gridRound(int half, double spacing)
{
  std::vector<Pose2> poses;
  for (int y = -half; y <= half; ++y) {
    for (int x = -half; x <= half; ++x) {
      poses.push_back({x * spacing, y * spacing, wrapAngle(0.7 * x - 1.9 * y)});
    }
  }
  return poses;
}

/** Homing to the origin of a painted room, and to a place near it. */
HomingTask taskIn(const SyntheticRoom &room)
{
  HomingTask task;
  task.viewPoses = gridRound(2, 0.5);
  task.homePoses = {{0.1, 0.05, 0.4}, {-0.3, 0.2, -2.0}};
  task.viewPanorama = [&room, poses = task.viewPoses](std::size_t i) {
    return room.view(poses.at(i));
  };
  task.homePanorama = [&room, poses = task.homePoses](std::size_t i) {
    return room.view(poses.at(i));
  };
  task.pairs = chooseHomingPairs(task.viewPoses, task.homePoses, kSeesAll);
  return task;
}

HomingTask paintedTask()
{
  static const SyntheticRoom room(4, 6.0, 5.0);
  return taskIn(room);
}

TEST(HomingPairs, areApartAsAskedAndInSight)
{
  const std::vector<Pose2> views = gridRound(6, 0.25);
  const std::vector<Pose2> homes{{0.0, 0.0, 0.0}, {0.6, 0.1, 1.0}, {-0.4, 0.7, 2.0}};
  const Sees left = [](const Eigen::Vector2d &a, const Eigen::Vector2d &) { return a.x() < 0.3; };
  const std::vector<HomingPair> pairs = chooseHomingPairs(views, homes, left, {0.4, 1.2, 1000, 1});
  std::size_t expected = 0;
  for (const Pose2 &view : views) {
    for (const Pose2 &home : homes) {
      const double apart = (view.translation() - home.translation()).norm();
      expected += view.x < 0.3 && apart >= 0.4 && apart <= 1.2 ? 1U : 0U;
    }
  }
  EXPECT_EQ(pairs.size(), expected);
  for (const HomingPair &pair : pairs) {
    EXPECT_LT(views[pair.view].x, 0.3);
  }
}

TEST(HomingPairs, wholeHomesUntilThereAreEnough)
{
  const std::vector<Pose2> views = gridRound(2, 0.5);
  const std::vector<Pose2> homes(5, Pose2{});
  EXPECT_EQ(chooseHomingPairs(views, homes, kSeesAll, {0.3, 2.5, 24, 4}).size(), 24U);
  EXPECT_EQ(chooseHomingPairs(views, homes, kSeesAll, {0.3, 2.5, 25, 4}).size(), 48U);
  EXPECT_EQ(chooseHomingPairs(views, homes, kSeesAll, {0.3, 2.5, 999, 4}).size(), 120U);
  EXPECT_TRUE(chooseHomingPairs(views, homes, kSeesAll, {0.3, 2.5, 999, 25}).empty());
  EXPECT_THROW(chooseHomingPairs(views, homes, kSeesAll, {0.5, 0.4, 9, 1}), LogicError);
}

TEST(HomingTask, takesHomesFromOneLightAndViewsFromTheOther)
{
  DataSet set(PanoramaLayout{}, {16, 8});
  for (int i = 0; i < 10; ++i) {
    set.add({std::to_string(i) + ".png", {0.5 * i, 0.0, 0.0}, i % 2 == 0 ? "day" : "night"},
            cv::Mat(8, 16, CV_8UC1, cv::Scalar(i)));
  }
  const HomingTask task = homingTask(set, "day", "night", kSeesAll, 3, {0.3, 2.5, 1000, 1});
  std::set<double> homes;
  for (const HomingPair &pair : task.pairs) {
    const double view = task.viewPanorama(pair.view).image.at<unsigned char>(0, 0);
    const double home = task.homePanorama(pair.home).image.at<unsigned char>(0, 0);
    EXPECT_EQ(static_cast<int>(view) % 2, 1);
    EXPECT_EQ(static_cast<int>(home) % 2, 0);
    EXPECT_EQ(task.viewPoses[pair.view].x, 0.5 * view);
    EXPECT_EQ(task.homePoses[pair.home].x, 0.5 * home);
    homes.insert(home);
  }
  EXPECT_EQ(homes.size(), 5U);
  EXPECT_THROW(homingTask(set, "day", "dusk", kSeesAll, 3), ConfigError);
}

TEST(HomingScore, theTruthIsFaultlessAndReturns)
{
  const HomingTask task = paintedTask();
  const HomingScore score = scoreHoming(task, {"truth", true, trueAnswers(task)});
  EXPECT_EQ(score.pairs, task.pairs.size());
  EXPECT_NEAR(score.meanDeg, 0.0, 1e-9);
  EXPECT_NEAR(score.compassMeanDeg, 0.0, 1e-9);
  EXPECT_EQ(score.shareOver90, 0.0);
  EXPECT_EQ(score.returnRatio, 1.0);
}

TEST(HomingScore, aTurnOfAllAnswersIsTheirError)
{
  const HomingTask task = paintedTask();
  for (const double turn : {0.3, -1.2, 2.0}) {
    HomingAnswers answers{"turned", true, trueAnswers(task)};
    for (auto &answer : answers.answers) {
      answer->direction = wrapAngle(answer->direction + turn);
      answer->headingChange = wrapAngle(answer->headingChange - 0.1);
    }
    const HomingScore score = scoreHoming(task, answers);
    EXPECT_NEAR(score.meanDeg, degrees(std::abs(turn)), 1e-9);
    EXPECT_NEAR(score.medianDeg, degrees(std::abs(turn)), 1e-9);
    EXPECT_NEAR(score.compassMeanDeg, degrees(0.1), 1e-9);
    EXPECT_EQ(score.shareOver90, turn == 2.0 ? 1.0 : 0.0);
  }
  // Straight away from home nobody returns.
  std::vector<std::optional<HomeVector>> away = trueAnswers(task);
  for (auto &answer : away) {
    answer->direction = wrapAngle(answer->direction + kPi);
  }
  EXPECT_EQ(returnRatio(task, away), 0.0);
}

TEST(HomingScore, settingTheUnsureAsideHelpsWhenTheyAreTheWrongOnes)
{
  const HomingTask task = paintedTask();
  HomingAnswers answers{"mixed", true, trueAnswers(task)};
  const std::size_t tenth = answers.answers.size() / 10;
  ASSERT_GE(tenth, 2U);
  for (std::size_t i = 1; i < tenth; ++i) {
    answers.answers[3 * i]->direction += kPi;
    answers.answers[3 * i]->confidence = 0.2;
  }
  answers.answers.back().reset();
  const HomingScore score = scoreHoming(task, answers);
  EXPECT_EQ(score.unanswered, 1U);
  EXPECT_NEAR(score.shareOver90,
              static_cast<double>(tenth) / static_cast<double>(task.pairs.size()), 1e-12);
  EXPECT_NEAR(score.meanDeg,
              (180.0 * static_cast<double>(tenth - 1) + 90.0) /
                  static_cast<double>(task.pairs.size()),
              1e-9);
  EXPECT_NEAR(score.sureMeanDeg, 0.0, 1e-9);
  EXPECT_EQ(score.sureShareOver90, 0.0);
  answers.answers.pop_back();
  EXPECT_THROW(scoreHoming(task, answers), LogicError);
}

TEST(HomingRun, answersAreTheSameWithOneThreadAndWithTwo)
{
  HomingTask task = paintedTask();
  task.pairs.resize(6);
  for (const char *method : {"minwarping-72", "hiss", "bearing", "alv", "combined", "compass"}) {
    const HomingAnswers one = runHoming(method, task, 1);
    const HomingAnswers two = runHoming(method, task, 2);
    ASSERT_EQ(one.answers.size(), task.pairs.size());
    for (std::size_t i = 0; i < task.pairs.size(); ++i) {
      ASSERT_EQ(one.answers[i].has_value(), two.answers[i].has_value()) << method;
      if (one.answers[i]) {
        EXPECT_EQ(one.answers[i]->direction, two.answers[i]->direction) << method;
        EXPECT_EQ(one.answers[i]->headingChange, two.answers[i]->headingChange) << method;
        EXPECT_EQ(one.answers[i]->confidence, two.answers[i]->confidence) << method;
      }
    }
  }
  EXPECT_THROW(runHoming("guess", task, 1), ConfigError);
}

TEST(HomingRun, methodsFindHomeInAPaintedRoom)
{
  const HomingTask task = paintedTask();
  const HomingScore warping = scoreHoming(task, runHoming("minwarping-72", task, 1));
  EXPECT_LT(warping.meanDeg, 8.0);
  EXPECT_GT(warping.returnRatio, 0.9);
  EXPECT_LT(warping.compassMeanDeg, 3.0);
  const HomingAnswers compass = runHoming("compass", task, 1);
  EXPECT_FALSE(compass.givesDirection);
}

TEST(HomingRun, aPictureThatCannotBeReadIsPassedOnFromAnyThread)
{
  HomingTask task = paintedTask();
  task.viewPanorama = [](std::size_t i) -> Panorama {
    throw ConfigError("picture " + std::to_string(i));
  };
  for (const int threads : {1, 2}) {
    try {
      runHoming("compass", task, threads);
      FAIL() << "nothing thrown";
    }
    catch (const ConfigError &error) {
      EXPECT_STREQ(error.what(), ("picture " + std::to_string(task.pairs.front().view)).c_str());
    }
  }
}

} // namespace
} // namespace homeward
