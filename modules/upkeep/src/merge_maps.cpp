// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/upkeep/merge_maps.h>

namespace homeward
{

namespace
{

/** The updates that add the places and ways of one map to another. */
class Addition
{
public:
  Addition(const TopologicalMap &map, const MapFile &other) : m_map(&map), m_other(&other)
  {
    NodeId next = map.nextNodeId();
    for (const auto &[id, node] : other.map().nodes()) {
      m_became.emplace(id, next);
      ++next.value;
    }
  }

  std::vector<MapUpdate> updates(const std::vector<PlacePair> &pairs)
  {
    std::vector<MapUpdate> updates;
    for (const auto &[id, node] : m_other->map().nodes()) {
      updates.push_back(nodeUpdate(node));
    }
    updates.push_back({.changes = ways()});
    for (const PlacePair &pair : pairs) {
      updates.back().changes.emplace_back(NodesMerged{pair.a, m_became.at(pair.b), pair.turn});
      m_became.at(pair.b) = pair.a;
    }
    return updates;
  }

  const std::map<NodeId, NodeId> &became() const { return m_became; }

private:
  MapUpdate nodeUpdate(Node node) const
  {
    const NodeId old = node.id;
    node.id = m_became.at(old);
    if (m_map->find(node.name)) {
      node.name.clear();
    }
    MapUpdate update{.changes = {NodeAdded{node}}};
    if (m_other->hasView(old)) {
      update.view = NewView{node.id, m_other->view(old)};
    }
    return update;
  }

  std::vector<MapChange> ways() const
  {
    std::vector<MapChange> ways;
    EdgeId next = m_map->nextEdgeId();
    for (const auto &[id, way] : m_other->map().edges()) {
      Edge edge = way;
      edge.id = next;
      edge.a = m_became.at(way.a);
      edge.b = m_became.at(way.b);
      ways.emplace_back(EdgeAdded{edge});
      ++next.value;
    }
    return ways;
  }

  const TopologicalMap *m_map;
  const MapFile *m_other;
  std::map<NodeId, NodeId> m_became;
};

} // namespace

std::map<NodeId, NodeId> mergeMaps(const MapFile &a, const MapFile &b,
                                   const std::vector<PlacePair> &pairs,
                                   const std::filesystem::path &output, MapFile::IfExists ifExists)
{
  b.expectMadeWith(a.header());
  MapFile merged = MapFile::copyOf(a, output, ifExists);
  Addition addition(a.map(), b);
  merged.append(addition.updates(pairs));
  merged.close();
  return addition.became();
}

} // namespace homeward
