// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/mission/step.h>
#include <homeward/pilot/pilot.h>
#include <homeward/robot/clock.h>
#include <homeward/store/map_file.h>

namespace homeward
{

/** Counts of a mission under way. */
struct MissionCounts
{
  int homingsTried = 0;
  int homingsArrived = 0;

  /** Takes a report of the pilot into account. */
  void note(const Report &report);
};

/** Makes every place of a map known to the pilot by sight. */
void rememberAll(const MapFile &file, Pilot &pilot);

/**
 * Puts what a step changes into the map file, in one transaction with its log lines; a new node is
 * known to the pilot by the picture as stored.
 * @param map the one that the changes are for; the file's when there is one
 * @param file open for writing, or null when the mission changes no map
 * @param now robot time of the log lines
 */
void keepStep(const std::vector<MapChange> &changes, const std::vector<std::string> &log,
              Pilot &pilot, const TopologicalMap &map, MapFile *file, Time now);

/**
 * Runs a mission to its end: what a step changes is in the map file before its command goes to the
 * pilot.
 * @param file open for writing, or null when the mission changes no map
 * @param enough asked after every command; true ends the mission as an interruption does
 * @param onStep called with every step after it was stored
 */
template <class Mission, class Enough, class OnStep>
Finish runMission(const Mission &mission, Step<typename Mission::State> step, Pilot &pilot,
                  const TopologicalMap &map, MapFile *file, const Clock &clock,
                  MissionCounts &counts, Enough enough, OnStep onStep)
{
  while (true) {
    keepStep(step.changes, step.log, pilot, map, file, clock.now());
    onStep(step);
    if (const auto *finish = std::get_if<Finish>(&step.command)) {
      pilot.execute(step.command);
      return *finish;
    }
    const Report report = pilot.execute(step.command);
    counts.note(report);
    step = mission.next(step.state, map, enough() ? Report(Interrupted{}) : report);
  }
}

} // namespace homeward
