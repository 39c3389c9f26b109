// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/evaluation/homing_task.h>
#include <homeward/homing/home_vector.h>

#include <optional>
#include <string>
#include <vector>

namespace homeward
{

/** What a method answered to every pair of a task. */
struct HomingAnswers
{
  std::string method;                             ///< its name
  bool givesDirection = true;                     ///< a visual compass does not
  std::vector<std::optional<HomeVector>> answers; ///< in the order of the pairs
  /**
   * Of processor time to prepare a view and compare it, mean; alv, did and combined prepare both
   * views for each comparison.
   */
  double milliseconds = 0.0;
};

/**
 * minwarping-thorough (kThoroughWarping), minwarping-288, minwarping-144, minwarping-72 (columns),
 * the other homingMethodNames(), hiss-published (cv::SIFT), compass, edge-compass.
 */
const std::vector<std::string> &homingMethods();

/**
 * Runs a method over a task; the answers do not depend on the number of threads.
 * @throw ConfigError naming the known methods, or a picture that cannot be read
 */
HomingAnswers runHoming(const std::string &method, const HomingTask &task, int threads);

/** How good the answers are. No answer counts as an error of 90 degrees, what guessing gets. */
struct HomingScore
{
  std::size_t pairs = 0;         ///< asked
  std::size_t unanswered = 0;    ///< without a home vector
  double meanDeg = 0.0;          ///< of the direction error
  double medianDeg = 0.0;        ///< likewise
  double shareOver90 = 0.0;      ///< of direction errors of 90 degrees or more: away from home
  double sureMeanDeg = 0.0;      ///< without the tenth that the method is least confident of
  double sureShareOver90 = 0.0;  ///< likewise
  double compassMeanDeg = 0.0;   ///< of the heading error
  double compassMedianDeg = 0.0; ///< likewise
  /** Share of views from which walking from view to view along the answers ends at home. */
  double returnRatio = 0.0;
};

/** Direction errors of the pairs, radians, in [0, pi]. */
std::vector<double> directionErrors(const HomingTask &task, const HomingAnswers &answers);

/** Compares answers with the truth. */
HomingScore scoreHoming(const HomingTask &task, const HomingAnswers &answers);

/**
 * HomingScore::returnRatio: from each view step after step to the view nearest to one step along
 * the home vector, among the views around that home. The walk ends at home when a step ends within
 * one step of it; it fails when it comes to a view twice or no view is within a step of its end.
 * A step is 1.1 times the median distance from a view to its nearest neighbour.
 */
double returnRatio(const HomingTask &task, const std::vector<std::optional<HomeVector>> &answers);

/** Answers that are the truth, for comparison. */
std::vector<std::optional<HomeVector>> trueAnswers(const HomingTask &task);

} // namespace homeward
