// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/evaluation/confidence.h>
#include <homeward/evaluation/mission_trial.h>

#include <vector>

namespace homeward
{

/** Drives to nodes, together. */
struct GoalSummary
{
  Share arrived;                  ///< at the goal, of all drives
  std::size_t wronglyArrived = 0; ///< said so, and were elsewhere
  double medianError = 0.0;       ///< metres, of those that arrived
  double medianHeadingDeg = 0.0;  ///< degrees, of those that arrived
  Mean seconds;                   ///< simulated, of those that arrived
  int collisions = 0;             ///< of all drives
  int unseenContacts = 0;         ///< of all drives

  Share firstRight;           ///< knew at first where they were, and were there
  std::size_t firstWrong = 0; ///< believed to know
  std::size_t neverKnew = 0;  ///< said that they were lost
  Mean secondsToKnow;         ///< simulated, of those that were right
};

/** Drives at barriers, together. */
struct BarredSummary
{
  Share right;                 ///< BarredDrive::right()
  std::size_t noWayLeft = 0;   ///< of these, said that the goal is unreachable
  std::size_t meetings = 0;    ///< with a barrier
  double longestMeeting = 0.0; ///< simulated s; 0 of none
  int collisions = 0;          ///< of all drives
  int unseenContacts = 0;      ///< of all drives
};

/** Trials of one world, together. Shares of homings and drives pool the trials. */
struct MissionSummary
{
  Share finished;             ///< came to an end by themselves
  Mean coverage;              ///< share of the reachable floor
  double leastCoverage = 0.0; ///< of a trial
  int falseEdges = 0;         ///< of all maps
  int duplicateNodes = 0;     ///< of all maps
  Mean nodes;                 ///< of a map
  Share homings;              ///< that arrived
  int collisions = 0;         ///< of all explorations
  int unseenContacts = 0;     ///< of all explorations
  Mean distance;              ///< metres
  Mean seconds;               ///< simulated
  Mean oracleLength;          ///< metres
  Mean distanceFactor; ///< distance driven over the oracle's; trials whose oracle stands are left
                       ///< out
  Mean secondsFactor;  ///< likewise, times
  GoalSummary goals;   ///< of drives to random nodes
  GoalSummary kidnappings; ///< of drives after being carried off
  BarredSummary barred;    ///< of drives at barriers
};

/** Of all drives together. */
GoalSummary summariseDrives(const std::vector<GoalDrive> &drives);

/** Of all drives at barriers together. */
BarredSummary summariseBarred(const std::vector<BarredDrive> &drives);

/** Of all trials together. */
MissionSummary summariseTrials(const std::vector<MissionTrial> &trials);

} // namespace homeward
