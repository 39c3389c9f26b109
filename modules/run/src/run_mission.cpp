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

MapUpdate updateOf(const std::vector<MapChange> &changes, const std::vector<std::string> &log,
                   const std::vector<NodeId> &refreshes, const Panorama &view, Time now)
{
  MapUpdate update;
  update.changes = changes;
  for (const std::string &line : log) {
    update.log.push_back({toSeconds(now), line});
  }
  for (const MapChange &change : changes) {
    if (const auto *added = std::get_if<NodeAdded>(&change)) {
      update.view = NewView{added->node.id, encodeView(view)};
    }
  }
  for (const NodeId node : refreshes) {
    update.refreshes.push_back({node, encodeView(view)});
  }
  return update;
}

} // namespace homeward
