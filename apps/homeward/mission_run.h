// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/mission/step.h>
#include <homeward/pilot/pilot.h>
#include <homeward/robot/clock.h>
#include <homeward/store/map_file.h>

#include <functional>
#include <variant>

namespace homeward
{

/** Counts of a mission under way. */
struct MissionCounts
{
  int homingsTried = 0;
  int homingsArrived = 0;
};

/**
 * Runs a mission to its end: what a step changes is in the map file, in one transaction, before its
 * command goes to the pilot. A new node is known to the pilot by the picture as stored.
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
    MapUpdate update;
    update.changes = step.changes;
    for (const std::string &line : step.log) {
      update.log.push_back({toSeconds(clock.now()), line});
    }
    for (const MapChange &change : step.changes) {
      if (const auto *added = std::get_if<NodeAdded>(&change)) {
        update.view = NewView{added->node.id, encodeView(pilot.view())};
      }
    }
    if (file != nullptr &&
        (!update.changes.empty() || (!update.log.empty() && !map.nodes().empty()))) {
      file->append(update);
    }
    if (update.view) {
      pilot.remember(update.view->node, decodeView(update.view->bytes, pilot.view().geometry));
    }
    onStep(step);
    if (const auto *finish = std::get_if<Finish>(&step.command)) {
      pilot.execute(step.command);
      return *finish;
    }
    const Report report = pilot.execute(step.command);
    if (const auto *homed = std::get_if<Homed>(&report)) {
      ++counts.homingsTried;
      counts.homingsArrived += homed->end == HomingEnd::Arrived ? 1 : 0;
    }
    step = mission.next(step.state, map, enough() ? Report(Interrupted{}) : report);
  }
}

} // namespace homeward
