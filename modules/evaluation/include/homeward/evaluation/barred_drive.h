// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/evaluation/goal_drive.h>

namespace homeward
{

/** A drive from one end of an edge to the other, with a barrier across it that no map knows. */
struct BarredDrive
{
  EdgeId edge;                       ///< that was barred
  double barrierWidth = 0.0;         ///< metres
  GoalDrive drive = {};              ///< at it
  bool noWayLeft = false;            ///< foundNoWay()
  std::vector<double> meetings = {}; ///< BarrierMeetings::seconds()

  /** Whether it arrived, or rightly said that it cannot. */
  bool right() const { return drive.arrived() || noWayLeft; }
};

/**
 * Whether a navigation that failed knew where it was, and was right in that the map has no way
 * left: none but over the barred edge and edges that it tried in vain.
 * @param end its last state
 */
bool foundNoWay(const TopologicalMap &map, Outcome outcome, const NavigatorState &end,
                EdgeId barred);

/**
 * Bars random edges (barrierAcross(), clear of every node), one after the other, and sends the
 * robot over each from one end, in a random heading in which it fits. The barrier is gone
 * afterwards.
 * @param file the finished map
 * @param truth where its nodes truly are
 * @param seed of edges, ends and headings; of two counts, the larger begins with the smaller
 * @param stop ends the drives; those that were driven to their end are returned
 * @return fewer than `count` when no more edges can be barred
 */
std::vector<BarredDrive> driveAtBarriers(const GoalDriver &driver, const MapFile &file,
                                         const TruthLog &truth, std::size_t count,
                                         std::uint64_t seed, const std::atomic<bool> &stop);

} // namespace homeward
