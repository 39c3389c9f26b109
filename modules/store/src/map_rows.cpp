// SPDX-License-Identifier: GPL-3.0-or-later
#include "map_rows.h"

#include "map_tables.h"
#include "number_text.h"

#include <homeward/core/error.h>
#include <homeward/store/content_hash.h>

#include <limits>

namespace homeward
{

namespace
{

constexpr std::string_view kThresholdPrefix = "threshold.";
constexpr std::int64_t kMostIds = 10'000'000; // a flipped bit must not ask for all memory

/** The header's keys and values as text, thresholds apart. */
class HeaderText
{
public:
  explicit HeaderText(Database &database) : m_database(&database)
  {
    Statement rows(database, "SELECT key, value FROM meta");
    while (rows.step()) {
      m_texts.emplace(rows.text(0), rows.text(1));
    }
  }

  std::string text(const std::string &key) const
  {
    const auto found = m_texts.find(key);
    if (found == m_texts.end()) {
      damaged(*m_database, "its header has no " + key);
    }
    return found->second;
  }

  double number(const std::string &key) const
  {
    const std::optional<double> value = parseNumber(text(key));
    if (!value) {
      damaged(*m_database, "its header says " + key + ": " + text(key) + ", which is no number");
    }
    return *value;
  }

  int count(const std::string &key) const
  {
    const double value = number(key);
    if (value < 1.0 || value > 1e6) {
      damaged(*m_database, "its header says " + key + ": " + text(key));
    }
    return static_cast<int>(value);
  }

  std::map<std::string, double> thresholds() const
  {
    std::map<std::string, double> thresholds;
    for (const auto &[key, unused] : m_texts) {
      if (key.starts_with(kThresholdPrefix)) {
        thresholds.emplace(key.substr(kThresholdPrefix.size()), number(key));
      }
    }
    return thresholds;
  }

private:
  Database *m_database;
  std::map<std::string, std::string> m_texts;
};

/** Removes what is no more, and what has changed. */
class RowRemover
{
public:
  explicit RowRemover(Database &database)
      : m_node(database, "DELETE FROM node WHERE id = ?"),
        m_directions(database, "DELETE FROM direction WHERE node = ?"),
        m_edge(database, "DELETE FROM edge WHERE id = ?"),
        m_view(database, "DELETE FROM view WHERE node = ?")
  {}

  void node(NodeId id)
  {
    m_directions.bind(id.value).run();
    m_node.bind(id.value).run();
  }
  void edge(EdgeId id) { m_edge.bind(id.value).run(); }
  void view(NodeId id) { m_view.bind(id.value).run(); }

private:
  Statement m_node;
  Statement m_directions;
  Statement m_edge;
  Statement m_view;
};

class RowWriter
{
public:
  explicit RowWriter(Database &database)
      : m_node(database, "INSERT INTO node(id, name) VALUES (?, ?)"),
        m_direction(database, "INSERT INTO direction VALUES (?, ?, ?, ?, ?, ?)"),
        m_edge(database, "INSERT INTO edge(id, a, b, bearing_at_a_rad, bearing_at_b_rad, length_m,"
                         " tries, successes, mean_seconds, last_error, last_time_s, forbidden)"
                         " VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)")
  {}

  void node(const Node &node)
  {
    m_node.bind(node.id.value).bind(std::string_view(node.name)).run();
    for (const Direction &direction : node.directions) {
      m_direction.bind(node.id.value)
          .bind(direction.id.value)
          .bind(direction.bearing)
          .bind(direction.width)
          .bind(name(direction.state))
          .bind(std::string_view(direction.reason))
          .run();
    }
  }

  void edge(const Edge &edge)
  {
    m_edge.bind(edge.id.value)
        .bind(edge.a.value)
        .bind(edge.b.value)
        .bind(edge.bearingAtA)
        .bind(edge.bearingAtB)
        .bind(edge.length)
        .bind(std::int64_t{edge.statistics.tries})
        .bind(std::int64_t{edge.statistics.successes})
        .bind(edge.statistics.meanSeconds)
        .bind(std::string_view(edge.statistics.lastError))
        .bind(edge.statistics.lastTime)
        .bind(std::int64_t{edge.forbidden ? 1 : 0})
        .run();
  }

private:
  Statement m_node;
  Statement m_direction;
  Statement m_edge;
};

void writeNextId(Database &database, std::string_view kind, std::int64_t id)
{
  Statement(database, "UPDATE next_id SET id = ? WHERE kind = ?").bind(id).bind(kind).run();
}

/** Whether `values` holds just this. */
template <class Values, class Key, class Value>
bool holds(const Values &values, Key id, const Value &value)
{
  const Value *found = values.find(id);
  return found != nullptr && *found == value;
}

int smallCount(const Database &database, std::int64_t count)
{
  if (count < 0 || count > std::numeric_limits<int>::max()) {
    damaged(database, "a count of " + std::to_string(count));
  }
  return static_cast<int>(count);
}

std::map<NodeId, std::vector<Direction>> readDirections(Database &database)
{
  std::map<NodeId, std::vector<Direction>> directions;
  Statement rows(database, "SELECT node, id, bearing_rad, width_rad, state, reason FROM direction"
                           " ORDER BY node, id");
  while (rows.step()) {
    const std::optional<DirectionState> state = parseDirectionState(rows.text(4));
    if (!state) {
      damaged(database, "direction state " + rows.text(4));
    }
    directions[{rows.integer(0)}].push_back({{rows.integer(1)},
                                             rows.real(2).value_or(0.0),
                                             rows.real(3).value_or(0.0),
                                             *state,
                                             rows.text(5)});
  }
  return directions;
}

std::vector<Node> readNodes(Database &database)
{
  std::map<NodeId, std::vector<Direction>> directions = readDirections(database);
  std::vector<Node> nodes;
  Statement rows(database, tableVersion(database) > 2 ? "SELECT id, name FROM node ORDER BY id"
                                                      : "SELECT id, '' FROM node ORDER BY id");
  while (rows.step()) {
    const NodeId id{rows.integer(0)};
    nodes.push_back({id, std::move(directions[id]), rows.text(1)});
  }
  return nodes;
}

const char *edgeColumns(std::int64_t version)
{
  switch (version) {
  case 1:
    return "SELECT id, a, b, bearing_at_a_rad, bearing_at_b_rad, NULL, 0, 0, 0.0, '', 0.0, 0"
           " FROM edge ORDER BY id";
  case 2:
    return "SELECT id, a, b, bearing_at_a_rad, bearing_at_b_rad, length_m, 0, 0, 0.0, '', 0.0, 0"
           " FROM edge ORDER BY id";
  default:
    return "SELECT id, a, b, bearing_at_a_rad, bearing_at_b_rad, length_m, tries, successes,"
           " mean_seconds, last_error, last_time_s, forbidden FROM edge ORDER BY id";
  }
}

std::vector<Edge> readEdges(Database &database)
{
  std::vector<Edge> edges;
  Statement rows(database, edgeColumns(tableVersion(database)));
  while (rows.step()) {
    edges.push_back({{rows.integer(0)},
                     {rows.integer(1)},
                     {rows.integer(2)},
                     rows.real(3),
                     rows.real(4),
                     rows.real(5),
                     {smallCount(database, rows.integer(6)), smallCount(database, rows.integer(7)),
                      rows.real(8).value_or(0.0), rows.text(9), rows.real(10).value_or(0.0)},
                     rows.integer(11) != 0});
  }
  return edges;
}

template <class Thing> std::int64_t afterLast(const std::vector<Thing> &things)
{
  return things.empty() ? 0 : things.back().id.value + 1;
}

std::int64_t readNextId(Database &database, std::string_view kind)
{
  Statement row(database, "SELECT id FROM next_id WHERE kind = ?");
  if (!row.bind(kind).step()) {
    damaged(database, "it does not know the next id of a " + std::string(kind));
  }
  return row.integer(0);
}

} // namespace

void writeHeader(Database &database, const MapHeader &header)
{
  Statement insert(database, "INSERT INTO meta VALUES (?, ?)");
  const auto put = [&](const std::string &key, const std::string &value) {
    insert.bind(std::string_view(key)).bind(std::string_view(value)).run();
  };
  put("camera_hash", header.cameraHash);
  put("panorama_width", std::to_string(header.panorama.width));
  put("panorama_height", std::to_string(header.panorama.height));
  put("panorama_elevation_min_rad", exactText(header.panorama.elevationMin));
  put("panorama_elevation_max_rad", exactText(header.panorama.elevationMax));
  put("signature_kind", header.signatureKind);
  put("signature_version", std::to_string(header.signatureVersion));
  for (const auto &[key, value] : header.thresholds) {
    put(std::string(kThresholdPrefix) + key, exactText(value));
  }
}

MapHeader readHeader(Database &database)
{
  const HeaderText text(database);
  MapHeader header;
  header.cameraHash = text.text("camera_hash");
  header.panorama = {text.count("panorama_width"), text.count("panorama_height"),
                     text.number("panorama_elevation_min_rad"),
                     text.number("panorama_elevation_max_rad")};
  header.signatureKind = text.text("signature_kind");
  header.signatureVersion = text.count("signature_version");
  header.thresholds = text.thresholds();
  return header;
}

void writeDifference(Database &database, const TopologicalMap &before, const TopologicalMap &after)
{
  // Rows may name each other in any order until the transaction ends.
  database.execute("PRAGMA defer_foreign_keys = ON");
  RowRemover remove(database);
  RowWriter write(database);
  for (const auto &[id, node] : before.nodes()) {
    if (!after.contains(id)) {
      remove.view(id);
    }
    if (!holds(after.nodes(), id, node)) {
      remove.node(id);
    }
  }
  for (const auto &[id, edge] : before.edges()) {
    if (!holds(after.edges(), id, edge)) {
      remove.edge(id);
    }
  }
  for (const auto &[id, node] : after.nodes()) {
    if (!holds(before.nodes(), id, node)) {
      write.node(node);
    }
  }
  for (const auto &[id, edge] : after.edges()) {
    if (!holds(before.edges(), id, edge)) {
      write.edge(edge);
    }
  }
  writeNextId(database, "node", after.nextNodeId().value);
  writeNextId(database, "edge", after.nextEdgeId().value);
}

void writeView(Database &database, const NewView &view)
{
  Statement(database, "INSERT INTO view VALUES (?, ?, ?)")
      .bind(view.node.value)
      .bind(std::string_view(hashText(contentHash(view.bytes))))
      .bind(std::span<const unsigned char>(view.bytes))
      .run();
}

void replaceView(Database &database, const NewView &view)
{
  Statement(database, "UPDATE view SET hash = ?, jpeg = ? WHERE node = ?")
      .bind(std::string_view(hashText(contentHash(view.bytes))))
      .bind(std::span<const unsigned char>(view.bytes))
      .bind(view.node.value)
      .run();
}

void writeLog(Database &database, const std::vector<LogLine> &lines)
{
  Statement insert(database, "INSERT INTO run_log(time_s, line) VALUES (?, ?)");
  for (const LogLine &line : lines) {
    insert.bind(line.time).bind(std::string_view(line.text)).run();
  }
}

void writeValues(Database &database, const std::map<std::string, std::string> &values)
{
  Statement insert(database, "INSERT OR REPLACE INTO value VALUES (?, ?)");
  for (const auto &[key, value] : values) {
    insert.bind(std::string_view(key)).bind(std::string_view(value)).run();
  }
}

TopologicalMap readMap(Database &database)
{
  const std::vector<Node> nodes = readNodes(database);
  const std::vector<Edge> edges = readEdges(database);
  const bool told = tableVersion(database) > 2;
  const NodeId nextNode{told ? readNextId(database, "node") : afterLast(nodes)};
  const EdgeId nextEdge{told ? readNextId(database, "edge") : afterLast(edges)};
  if (nextNode.value > kMostIds || nextEdge.value > kMostIds) {
    damaged(database, "ids beyond " + std::to_string(kMostIds));
  }
  try {
    return {nodes, edges, nextNode, nextEdge};
  }
  catch (const LogicError &error) {
    damaged(database, error.what());
  }
}

} // namespace homeward
