// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/mission/step.h>
#include <homeward/pilot/pilot.h>
#include <homeward/robot/clock.h>
#include <homeward/run/kept_exploration.h>
#include <homeward/store/map_file.h>

namespace homeward
{

/** Counts of a mission under way. */
struct MissionCounts
{
  int homingsTried = 0;   ///< drives to places by sight
  int homingsArrived = 0; ///< of these

  /** Takes a report of the pilot into account. */
  void note(const Report &report);
};

/** Makes every place of a map known by sight to a pilot (Pilot, or what stands in for it). */
template <class AnyPilot> void rememberAll(const MapFile &file, AnyPilot &pilot)
{
  for (const auto &[id, node] : file.map().nodes()) {
    pilot.remember(id, file.panorama(id));
  }
}

/**
 * How many times a map file's picture of a node was refreshed: each was taken some centimetres off
 * the one before. @throw StoreError when the file's value is none
 */
int refreshesOf(const MapFile &file, NodeId node);

/** The value of a map file that says so from now on, see MapUpdate::values. */
std::pair<std::string, std::string> refreshesValue(NodeId node, int refreshes);

/** What a mission keeps of its state in the map file; nothing of one that makes no map. */
template <class State> std::map<std::string, std::string> keptValues(const State & /*state*/)
{
  return {};
}

/** An exploration keeps all of it. */
inline std::map<std::string, std::string> keptValues(const ExplorerState &state)
{
  return {{kExplorationKey, explorerStateJson(state)}};
}

/**
 * What a step puts into the map file.
 * @param refreshes nodes that are seen by another view from now on
 * @param view the pilot's, which a new node or a refreshed one is seen by
 * @param now robot time of the log lines
 */
MapUpdate updateOf(const std::vector<MapChange> &changes, const std::vector<std::string> &log,
                   const std::vector<NodeId> &refreshes, const Panorama &view, Time now);

/**
 * Puts a step into the map file, in one transaction: changes, the new node's view, newer views, log
 * lines and the mission's state. Then the pilot knows these nodes by the pictures as stored.
 *
 * Every step is written once the map has a place, also one that changes nothing: what it learnt (a
 * leg that failed, a drive that led nowhere) must not be learnt again after a crash, steps are
 * seconds apart and a transaction takes milliseconds.
 * @param file open for writing, or null when the mission changes no map
 */
template <class State, class AnyPilot>
void keepStep(const Step<State> &step, AnyPilot &pilot, MapFile *file, Time now)
{
  MapUpdate update = updateOf(step.changes, step.log, step.refreshes, pilot.view(), now);
  if (file != nullptr && (!file->map().nodes().empty() || !step.changes.empty())) {
    update.values = keptValues(step.state);
    for (const NodeId node : step.refreshes) {
      update.values.insert(refreshesValue(node, refreshesOf(*file, node) + 1));
    }
    file->append(update);
  }
  if (update.view) {
    pilot.remember(update.view->node, decodeView(update.view->bytes, pilot.view().geometry));
  }
  for (const NewView &newer : update.refreshes) {
    pilot.remember(newer.node, decodeView(newer.bytes, pilot.view().geometry));
  }
}

/**
 * Runs a mission to its end: a step is in the map file before its command goes to the pilot.
 * @param pilot a Pilot, or what stands in for it: execute(Command), view(), remember()
 * @param map the one that the changes are for; the file's when there is one
 * @param file open for writing, or null when the mission changes no map
 * @param enough asked after every command; true ends the mission as an interruption does
 * @param onStep called with every step after it was stored
 */
template <class Mission, class AnyPilot, class Enough, class OnStep>
Finish runMission(const Mission &mission, Step<typename Mission::State> step, AnyPilot &pilot,
                  const TopologicalMap &map, MapFile *file, const Clock &clock,
                  MissionCounts &counts, Enough enough, OnStep onStep)
{
  while (true) {
    keepStep(step, pilot, file, clock.now());
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
