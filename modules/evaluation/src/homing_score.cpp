// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/evaluation/homing_run.h>

#include "median.h"

#include <homeward/core/error.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <span>

namespace homeward
{

namespace
{

using Answers = std::vector<std::optional<HomeVector>>;

constexpr double kGuess = kPi / 2.0;

void check(const HomingTask &task, const Answers &answers)
{
  if (answers.size() != task.pairs.size()) {
    throw LogicError(std::to_string(answers.size()) + " answers to " +
                     std::to_string(task.pairs.size()) + " homing pairs");
  }
}

double mean(const std::vector<double> &values)
{
  return values.empty() ? 0.0
                        : std::accumulate(values.begin(), values.end(), 0.0) /
                              static_cast<double>(values.size());
}

double shareOver90(const std::vector<double> &errors)
{
  const auto over =
      std::count_if(errors.begin(), errors.end(), [](double error) { return error >= kGuess; });
  return errors.empty() ? 0.0 : static_cast<double>(over) / static_cast<double>(errors.size());
}

/** Errors without those of the tenth with the least confidence; ties in the order of the pairs. */
std::vector<double> sureErrors(const std::vector<double> &errors, const Answers &answers)
{
  std::vector<std::size_t> order(errors.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto confidence = [&](std::size_t i) { return answers[i] ? answers[i]->confidence : -1.0; };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return confidence(a) < confidence(b); });
  std::vector<double> sure;
  for (std::size_t i = errors.size() / 10; i < order.size(); ++i) {
    sure.push_back(errors[order[i]]);
  }
  return sure;
}

/** The pairs of one home, on which a walk goes from view to view. */
class Walk
{
public:
  Walk(const HomingTask &task, std::span<const HomingPair> pairs,
       std::span<const std::optional<HomeVector>> answers)
      : m_home(task.homePoses.at(pairs.front().home).translation())
  {
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const Pose2 &view = task.viewPoses.at(pairs[i].view);
      m_places.push_back(view.translation());
      const double heading = answers[i] ? view.heading + answers[i]->direction : 0.0;
      m_steps.push_back(answers[i] ? Eigen::Vector2d(std::cos(heading), std::sin(heading))
                                   : Eigen::Vector2d(0.0, 0.0));
    }
    m_step = 1.1 * spacing();
  }

  bool returnsFrom(std::size_t start) const
  {
    std::set<std::size_t> visited;
    for (std::size_t at = start; visited.insert(at).second;) {
      const Eigen::Vector2d target = m_places[at] + m_step * m_steps[at];
      if ((target - m_home).norm() <= m_step) {
        return !m_steps[at].isZero();
      }
      const std::size_t next = nearestTo(target, at);
      if ((m_places[next] - target).norm() > m_step) {
        return false;
      }
      at = next;
    }
    return false;
  }

private:
  std::size_t nearestTo(const Eigen::Vector2d &point, std::size_t except) const
  {
    std::size_t best = except;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < m_places.size(); ++i) {
      const double distance = (m_places[i] - point).norm();
      if (i != except && distance < least) {
        least = distance;
        best = i;
      }
    }
    return best;
  }

  double spacing() const
  {
    std::vector<double> distances;
    for (std::size_t i = 0; i < m_places.size(); ++i) {
      distances.push_back((m_places[nearestTo(m_places[i], i)] - m_places[i]).norm());
    }
    return median(distances);
  }

  Eigen::Vector2d m_home;
  std::vector<Eigen::Vector2d> m_places;
  std::vector<Eigen::Vector2d> m_steps; ///< unit, or zero without an answer
  double m_step = 0.0;                  ///< metres
};

} // namespace

std::vector<double> directionErrors(const HomingTask &task, const HomingAnswers &answers)
{
  check(task, answers.answers);
  std::vector<double> errors;
  for (std::size_t i = 0; i < task.pairs.size(); ++i) {
    const std::optional<HomeVector> &answer = answers.answers[i];
    const double truth = task.trueDirection(task.pairs[i]);
    errors.push_back(answer ? std::abs(wrapAngle(answer->direction - truth)) : kGuess);
  }
  return errors;
}

double returnRatio(const HomingTask &task, const Answers &answers)
{
  check(task, answers);
  std::size_t returned = 0;
  for (std::size_t begin = 0; begin < task.pairs.size();) {
    std::size_t end = begin;
    while (end < task.pairs.size() && task.pairs[end].home == task.pairs[begin].home) {
      ++end;
    }
    const std::size_t count = end - begin;
    const Walk walk(task, std::span(task.pairs).subspan(begin, count),
                    std::span(answers).subspan(begin, count));
    for (std::size_t start = 0; start < count; ++start) {
      returned += walk.returnsFrom(start) ? 1U : 0U;
    }
    begin = end;
  }
  return task.pairs.empty()
             ? 0.0
             : static_cast<double>(returned) / static_cast<double>(task.pairs.size());
}

Answers trueAnswers(const HomingTask &task)
{
  Answers answers;
  for (const HomingPair &pair : task.pairs) {
    answers.emplace_back(
        HomeVector{task.trueDirection(pair), 1.0, task.trueHeadingChange(pair), 1.0});
  }
  return answers;
}

HomingScore scoreHoming(const HomingTask &task, const HomingAnswers &answers)
{
  const std::vector<double> errors = directionErrors(task, answers);
  const std::vector<double> sure = sureErrors(errors, answers.answers);
  std::vector<double> headingErrors;
  HomingScore score;
  score.pairs = errors.size();
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const std::optional<HomeVector> &answer = answers.answers[i];
    const double truth = task.trueHeadingChange(task.pairs[i]);
    headingErrors.push_back(answer ? std::abs(wrapAngle(answer->headingChange - truth)) : kGuess);
    score.unanswered += answer ? 0U : 1U;
  }
  score.compassMeanDeg = degrees(mean(headingErrors));
  score.compassMedianDeg = degrees(median(headingErrors));
  if (answers.givesDirection) {
    score.meanDeg = degrees(mean(errors));
    score.medianDeg = degrees(median(errors));
    score.shareOver90 = shareOver90(errors);
    score.sureMeanDeg = degrees(mean(sure));
    score.sureShareOver90 = shareOver90(sure);
    score.returnRatio = returnRatio(task, answers.answers);
  }
  return score;
}

} // namespace homeward
