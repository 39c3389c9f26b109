// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "synthetic_room.h"

#include <homeward/store/map_file.h>

#include <filesystem>
#include <vector>

namespace homeward
{

/** A map of places in a synthetic room, each joined to the next by what odometry would say. */
inline void writeRoomMap(const std::filesystem::path &path, const SyntheticRoom &room,
                         const std::vector<Pose2> &places, const std::string &camera = "camera")
{
  const PanoramaGeometry geometry;
  auto file = MapFile::create(path, {camera, geometry, "histogram", 1, {}});
  for (std::size_t i = 0; i < places.size(); ++i) {
    const NodeId id = file.map().nextNodeId();
    MapUpdate update{.changes = {NodeAdded{{id}}},
                     .view = NewView{id, encodeView(room.view(places[i]))}};
    if (i > 0) {
      const NodeId before{id.value - 1};
      update.changes.emplace_back(
          EdgeAdded{{file.map().nextEdgeId(), before, id, trueDirection(places[i - 1], places[i]),
                     trueDirection(places[i], places[i - 1]),
                     (places[i].translation() - places[i - 1].translation()).norm()}});
    }
    file.append(update);
  }
  file.close();
}

} // namespace homeward
