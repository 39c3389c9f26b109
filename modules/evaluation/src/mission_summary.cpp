// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/evaluation/mission_summary.h>

#include "median.h"

#include <homeward/core/angle.h>

#include <algorithm>
#include <iterator>

namespace homeward
{
namespace
{

/** Of what cannot be negative, nor can its mean. */
Mean meanOfAmounts(const std::vector<double> &values)
{
  Mean mean = meanOf(values);
  if (mean.interval) {
    mean.interval->low = std::max(0.0, mean.interval->low);
  }
  return mean;
}

template <class Value> Mean meanOver(const std::vector<MissionTrial> &trials, const Value &value)
{
  std::vector<double> values;
  std::transform(trials.begin(), trials.end(), std::back_inserter(values), value);
  return meanOfAmounts(values);
}

template <class Drive>
std::vector<Drive> all(const std::vector<MissionTrial> &trials,
                       std::vector<Drive> MissionTrial::*drives)
{
  std::vector<Drive> pooled;
  for (const MissionTrial &trial : trials) {
    pooled.insert(pooled.end(), (trial.*drives).begin(), (trial.*drives).end());
  }
  return pooled;
}

void noteFirstPlace(const GoalDrive &drive, GoalSummary &summary, std::vector<double> &seconds)
{
  ++summary.firstRight.trials;
  if (!drive.first) {
    ++summary.neverKnew;
  }
  else if (drive.first->right()) {
    ++summary.firstRight.successes;
    seconds.push_back(drive.first->seconds);
  }
  else {
    ++summary.firstWrong;
  }
}

void compareWithOracle(const std::vector<MissionTrial> &trials, MissionSummary &summary)
{
  std::vector<double> distances;
  std::vector<double> seconds;
  for (const MissionTrial &trial : trials) {
    if (trial.oracle.length > 0.0) {
      distances.push_back(trial.distance / trial.oracle.length);
      seconds.push_back(trial.seconds / trial.oracleSeconds);
    }
  }
  summary.distanceFactor = meanOfAmounts(distances);
  summary.secondsFactor = meanOfAmounts(seconds);
}

} // namespace

GoalSummary summariseDrives(const std::vector<GoalDrive> &drives)
{
  GoalSummary summary;
  std::vector<double> errors;
  std::vector<double> headings;
  std::vector<double> seconds;
  std::vector<double> secondsToKnow;
  for (const GoalDrive &drive : drives) {
    summary.collisions += drive.collisions;
    summary.unseenContacts += drive.unseenContacts;
    noteFirstPlace(drive, summary, secondsToKnow);
    if (drive.arrived()) {
      errors.push_back(drive.error);
      headings.push_back(degrees(drive.headingError));
      seconds.push_back(drive.seconds);
    }
    else if (drive.outcome == Outcome::Done) {
      ++summary.wronglyArrived;
    }
  }
  summary.arrived = {errors.size(), drives.size()};
  summary.medianError = median(errors);
  summary.medianHeadingDeg = median(headings);
  summary.seconds = meanOfAmounts(seconds);
  summary.secondsToKnow = meanOfAmounts(secondsToKnow);
  return summary;
}

BarredSummary summariseBarred(const std::vector<BarredDrive> &drives)
{
  BarredSummary summary;
  for (const BarredDrive &barred : drives) {
    ++summary.right.trials;
    summary.right.successes += barred.right() ? 1 : 0;
    summary.noWayLeft += barred.noWayLeft ? 1 : 0;
    summary.meetings += barred.meetings.size();
    for (const double seconds : barred.meetings) {
      summary.longestMeeting = std::max(summary.longestMeeting, seconds);
    }
    summary.collisions += barred.drive.collisions;
    summary.unseenContacts += barred.drive.unseenContacts;
  }
  return summary;
}

MissionSummary summariseTrials(const std::vector<MissionTrial> &trials)
{
  MissionSummary summary;
  summary.leastCoverage = trials.empty() ? 0.0 : 1.0;
  for (const MissionTrial &trial : trials) {
    ++summary.finished.trials;
    summary.finished.successes += trial.outcome == Outcome::Done ? 1 : 0;
    summary.homings.trials += static_cast<std::size_t>(trial.homings.homingsTried);
    summary.homings.successes += static_cast<std::size_t>(trial.homings.homingsArrived);
    summary.leastCoverage = std::min(summary.leastCoverage, trial.truth.coverage);
    summary.falseEdges += trial.truth.falseEdges;
    summary.duplicateNodes += trial.truth.duplicateNodes;
    summary.collisions += trial.collisions;
    summary.unseenContacts += trial.unseenContacts;
  }
  summary.coverage = meanOver(trials, [](const MissionTrial &t) { return t.truth.coverage; });
  if (summary.coverage.interval) {
    summary.coverage.interval->high = std::min(1.0, summary.coverage.interval->high);
  }
  summary.nodes =
      meanOver(trials, [](const MissionTrial &t) { return static_cast<double>(t.nodes); });
  summary.distance = meanOver(trials, [](const MissionTrial &t) { return t.distance; });
  summary.seconds = meanOver(trials, [](const MissionTrial &t) { return t.seconds; });
  summary.oracleLength = meanOver(trials, [](const MissionTrial &t) { return t.oracle.length; });
  compareWithOracle(trials, summary);
  summary.goals = summariseDrives(all(trials, &MissionTrial::goals));
  summary.kidnappings = summariseDrives(all(trials, &MissionTrial::kidnappings));
  summary.barred = summariseBarred(all(trials, &MissionTrial::barred));
  return summary;
}

} // namespace homeward
