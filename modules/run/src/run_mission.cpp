// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/run/run_mission.h>

#include <variant>

namespace homeward
{

void MissionCounts::note(const Report &report)
{
  if (const auto *homed = std::get_if<Homed>(&report)) {
    ++homingsTried;
    homingsArrived += homed->end == HomingEnd::Arrived ? 1 : 0;
  }
}

void rememberAll(const MapFile &file, Pilot &pilot)
{
  for (const auto &[id, node] : file.map().nodes()) {
    pilot.remember(id, file.panorama(id));
  }
}

void keepStep(const std::vector<MapChange> &changes, const std::vector<std::string> &log,
              Pilot &pilot, const TopologicalMap &map, MapFile *file, Time now)
{
  MapUpdate update;
  update.changes = changes;
  for (const std::string &line : log) {
    update.log.push_back({toSeconds(now), line});
  }
  for (const MapChange &change : changes) {
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
}

} // namespace homeward
