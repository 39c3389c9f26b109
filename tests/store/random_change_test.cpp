// SPDX-License-Identifier: GPL-3.0-or-later
#include "store_fixture.h"

#include <homeward/core/error.h>
#include <homeward/core/random.h>
#include <homeward/store/export.h>
#include <homeward/store/map_check.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <limits>
#include <set>

namespace homeward
{
namespace
{

using ::testing::IsEmpty;

/** Draws changes of every kind; many of them break a rule. */
class ChangeSource
{
public:
  /** Up to four changes that keep the rules, with the new node's view. */
  MapUpdate update(TopologicalMap map)
  {
    MapUpdate update;
    for (int i = 0; i < 20 && update.changes.size() < 4 && !update.view; ++i) {
      const MapChange change = draw(map);
      const TopologicalMap before = map;
      try {
        map.apply(change);
        update.changes.push_back(change);
        if (const auto *added = std::get_if<NodeAdded>(&change)) {
          const int seed = static_cast<int>(added->node.id.value % 6);
          update.view = NewView{added->node.id, encodeView(smallPanorama(seed))};
        }
      }
      catch (const LogicError &) {
        EXPECT_EQ(map, before);
      }
    }
    return update;
  }

  std::int64_t below(std::int64_t n)
  {
    return static_cast<std::int64_t>(unit() * static_cast<double>(n));
  }

private:
  MapChange draw(const TopologicalMap &map)
  {
    switch (below(12)) {
    case 0:
    case 1:
    case 2:
      return NodeAdded{{map.nextNodeId(), {{{0}, angle(), 0.3}, {{1}, angle(), 0.2}}}};
    case 3:
    case 4:
    case 5:
      return EdgeAdded{{map.nextEdgeId(), node(map), node(map), angle(), std::nullopt, 1.5}};
    case 6:
      return DirectionSettled{node(map), {below(3)}, DirectionState::Closed, "blocked"};
    case 7:
      return NodeNamed{node(map), "place " + std::to_string(below(20))};
    case 8:
      return below(3) == 0 ? MapChange(NodeRemoved{node(map)}) : EdgeRemoved{edge(map)};
    case 9:
      return EdgeForbidden{edge(map), below(2) == 0};
    case 10:
      return EdgeTried{edge(map), below(3) == 0 ? "lost" : "", 10.0 * unit(), 100.0 * unit()};
    default:
      return NodesMerged{node(map), node(map), angle()};
    }
  }

  double unit() { return m_random.uniform(0.0, 1.0); }
  double angle() { return m_random.uniform(-3.0, 3.0); }
  NodeId node(const TopologicalMap &map) { return {below(map.nextNodeId().value + 1)}; }
  EdgeId edge(const TopologicalMap &map) { return {below(map.nextEdgeId().value + 1)}; }

  Random m_random{7, 0};
};

/** What the docstring of TopologicalMap promises, seen from outside. */
void expectInvariants(const TopologicalMap &map)
{
  std::set<std::pair<NodeId, NodeId>> pairs;
  for (const auto &[id, edge] : map.edges()) {
    ASSERT_EQ(edge.id, id);
    ASSERT_TRUE(map.contains(edge.a) && map.contains(edge.b) && edge.a != edge.b);
    ASSERT_TRUE(pairs.insert(std::minmax(edge.a, edge.b)).second);
    ASSERT_EQ(map.edgeBetween(edge.b, edge.a), edge);
    ASSERT_LE(edge.statistics.successes, edge.statistics.tries);
    ASSERT_LT(id, map.nextEdgeId());
  }
  std::set<std::string> names;
  std::size_t ends = 0;
  for (const auto &[id, node] : map.nodes()) {
    ASSERT_EQ(node.id, id);
    ASSERT_LT(id, map.nextNodeId());
    ASSERT_TRUE(node.name.empty() || names.insert(node.name).second);
    ASSERT_TRUE(node.name.empty() || map.find(node.name) == id);
    const std::vector<NodeId> near = map.neighbours(id);
    ASSERT_TRUE(std::is_sorted(near.begin(), near.end()));
    for (const Link &link : map.links(id)) {
      const Edge edge = *map.edgeBetween(id, link.to);
      ASSERT_EQ(link.edge, edge.id);
      ASSERT_EQ(link.metres,
                edge.forbidden ? std::numeric_limits<double>::infinity() : expectedMetres(edge));
      ++ends;
    }
    ASSERT_EQ(map.hasOpenDirection(id),
              std::any_of(node.directions.begin(), node.directions.end(),
                          [](const Direction &one) { return one.state == DirectionState::Open; }));
  }
  ASSERT_EQ(ends, 2 * map.edges().size());
}

TEST_F(StoreTest, WhateverChangesMemoryAndFileSayTheSame)
{
  ChangeSource source;
  auto first = MapFile::create(path(), smallHeader());
  first.append(nodeUpdate(0));
  first.close();
  auto file = std::make_unique<MapFile>(MapFile::open(path()));
  std::vector<std::string> beforeEdits; // of the edits at the journal's end
  int made = 0;
  int undone = 0;
  for (int round = 0; made < 2000; ++round) {
    const TopologicalMap before = file->map();
    const MapUpdate update = source.update(before);
    made += static_cast<int>(update.changes.size());
    if (source.below(3) == 0) {
      beforeEdits.push_back(exportCanonical(*file));
      file->edit("change " + std::to_string(round), update);
    }
    else {
      file->append(update);
      beforeEdits.clear();
    }
    ASSERT_NO_FATAL_FAILURE(expectInvariants(file->map()));
    ASSERT_LE(before.nextNodeId().value, file->map().nextNodeId().value);
    ASSERT_LE(before.nextEdgeId().value, file->map().nextEdgeId().value);
    while (!beforeEdits.empty() && source.below(3) == 0) {
      file->undo();
      ASSERT_EQ(exportCanonical(*file), beforeEdits.back());
      beforeEdits.pop_back();
      ++undone;
    }
    if (round % 20 == 0) {
      const TopologicalMap map = file->map();
      const std::string text = exportCanonical(*file);
      file.reset();
      file = std::make_unique<MapFile>(MapFile::open(path()));
      ASSERT_EQ(file->map(), map);
      ASSERT_EQ(exportCanonical(*file), text);
      ASSERT_THAT(checkMap(path()).findings, IsEmpty());
    }
  }
  EXPECT_GT(undone, 50);
  EXPECT_GT(file->map().nodes().size(), 20U);
}

} // namespace
} // namespace homeward
