// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/run/run_mission.h>

#include <homeward/core/error.h>

#include <charconv>
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

int refreshesOf(const MapFile &file, NodeId node)
{
  const std::optional<std::string> value = file.value(refreshesValue(node, 0).first);
  if (!value) {
    return 0;
  }
  int refreshes = 0;
  const char *end = value->data() + value->size();
  if (std::from_chars(value->data(), end, refreshes).ptr != end) {
    throw StoreError(file.path().string() + ": '" + *value +
                     "' is no number of refreshes of node " + std::to_string(node.value) +
                     "; take an older copy of the map");
  }
  return refreshes;
}

std::pair<std::string, std::string> refreshesValue(NodeId node, int refreshes)
{
  return {"refreshes " + std::to_string(node.value), std::to_string(refreshes)};
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
