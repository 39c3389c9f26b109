// SPDX-License-Identifier: GPL-3.0-or-later
#include "map_rows.h"

#include "number_text.h"

#include <homeward/core/error.h>
#include <homeward/store/content_hash.h>

namespace homeward
{

namespace
{

constexpr std::int64_t kApplicationId = 0x48774d70; // "HwMp" in the file's header
constexpr std::int64_t kSchemaVersion = 2;
constexpr std::string_view kThresholdPrefix = "threshold.";

constexpr const char *kTables = R"(
CREATE TABLE meta(key TEXT PRIMARY KEY, value TEXT NOT NULL) STRICT;
CREATE TABLE value(key TEXT PRIMARY KEY, value TEXT NOT NULL) STRICT;
CREATE TABLE node(id INTEGER PRIMARY KEY) STRICT;
CREATE TABLE direction(
  node INTEGER NOT NULL REFERENCES node(id),
  id INTEGER NOT NULL,
  bearing_rad REAL NOT NULL,
  width_rad REAL NOT NULL,
  state TEXT NOT NULL CHECK (state IN ('open', 'driven', 'closed')),
  reason TEXT NOT NULL,
  PRIMARY KEY (node, id)) STRICT;
CREATE TABLE edge(
  id INTEGER PRIMARY KEY,
  a INTEGER NOT NULL REFERENCES node(id),
  b INTEGER NOT NULL REFERENCES node(id),
  bearing_at_a_rad REAL,
  bearing_at_b_rad REAL,
  length_m REAL) STRICT;
CREATE TABLE view(
  node INTEGER PRIMARY KEY REFERENCES node(id),
  hash TEXT NOT NULL,
  jpeg BLOB NOT NULL) STRICT;
CREATE TABLE run_log(seq INTEGER PRIMARY KEY, time_s REAL NOT NULL, line TEXT NOT NULL) STRICT;
)";

[[noreturn]] void damaged(const Database &database, const std::string &why)
{
  throw StoreError("map " + database.file().string() + " is damaged (" + why +
                   "); use a copy of it");
}

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

void write(Database &database, const NodeAdded &change)
{
  Statement(database, "INSERT INTO node(id) VALUES (?)").bind(change.node.id.value).run();
  Statement insert(database, "INSERT INTO direction VALUES (?, ?, ?, ?, ?, ?)");
  for (const Direction &direction : change.node.directions) {
    insert.bind(change.node.id.value)
        .bind(direction.id.value)
        .bind(direction.bearing)
        .bind(direction.width)
        .bind(name(direction.state))
        .bind(std::string_view(direction.reason))
        .run();
  }
}

void write(Database &database, const EdgeAdded &change)
{
  const Edge &edge = change.edge;
  Statement(database, "INSERT INTO edge VALUES (?, ?, ?, ?, ?, ?)")
      .bind(edge.id.value)
      .bind(edge.a.value)
      .bind(edge.b.value)
      .bind(edge.bearingAtA)
      .bind(edge.bearingAtB)
      .bind(edge.length)
      .run();
}

void write(Database &database, const DirectionSettled &change)
{
  Statement(database, "UPDATE direction SET state = ?, reason = ? WHERE node = ? AND id = ?")
      .bind(name(change.state))
      .bind(std::string_view(change.reason))
      .bind(change.node.value)
      .bind(change.direction.value)
      .run();
}

std::vector<Direction> readDirections(Database &database, NodeId node)
{
  std::vector<Direction> directions;
  Statement rows(database, "SELECT id, bearing_rad, width_rad, state, reason FROM direction"
                           " WHERE node = ? ORDER BY id");
  rows.bind(node.value);
  while (rows.step()) {
    const std::optional<DirectionState> state = parseDirectionState(rows.text(3));
    if (!state) {
      damaged(database, "direction state " + rows.text(3));
    }
    directions.push_back({{rows.integer(0)},
                          rows.real(1).value_or(0.0),
                          rows.real(2).value_or(0.0),
                          *state,
                          rows.text(4)});
  }
  return directions;
}

} // namespace

void createTables(Database &database)
{
  database.execute(kTables);
  database.execute(("PRAGMA application_id = " + std::to_string(kApplicationId)).c_str());
  database.execute(("PRAGMA user_version = " + std::to_string(kSchemaVersion)).c_str());
}

void checkTables(Database &database)
{
  const std::string file = database.file().string();
  if (database.integer("PRAGMA application_id") != kApplicationId) {
    throw StoreError("map " + file +
                     " is not a Homeward map; give a file that `homeward explore` wrote");
  }
  const std::int64_t version = database.integer("PRAGMA user_version");
  if (version > kSchemaVersion) {
    throw StoreError("map " + file + " has version " + std::to_string(version) +
                     ", this program reads up to " + std::to_string(kSchemaVersion) +
                     "; use a newer Homeward");
  }
  if (version < 1) {
    damaged(database, "version " + std::to_string(version));
  }
  const std::string report = database.text("PRAGMA integrity_check(1)");
  if (report != "ok") {
    damaged(database, report.substr(report.find_last_of('\n') + 1));
  }
  const std::string orphan = database.text("PRAGMA foreign_key_check");
  if (!orphan.empty()) {
    damaged(database, "table " + orphan + " names a place that is not there");
  }
}

void migrateTables(Database &database)
{
  if (database.integer("PRAGMA user_version") == kSchemaVersion) {
    return;
  }
  Transaction transaction(database);
  database.execute("ALTER TABLE edge ADD COLUMN length_m REAL");
  database.execute(("PRAGMA user_version = " + std::to_string(kSchemaVersion)).c_str());
  transaction.commit();
}

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

void writeChange(Database &database, const MapChange &change)
{
  std::visit([&](const auto &one) { write(database, one); }, change);
}

void writeView(Database &database, const NewView &view)
{
  Statement(database, "INSERT INTO view VALUES (?, ?, ?)")
      .bind(view.node.value)
      .bind(std::string_view(hashText(contentHash(view.bytes))))
      .bind(std::span<const unsigned char>(view.bytes))
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
  TopologicalMap map;
  try {
    Statement nodes(database, "SELECT id FROM node ORDER BY id");
    while (nodes.step()) {
      const NodeId id{nodes.integer(0)};
      map.apply(NodeAdded{{id, readDirections(database, id)}});
    }
    const bool lengths = database.integer("PRAGMA user_version") > 1;
    Statement edges(database, lengths ? "SELECT * FROM edge ORDER BY id"
                                      : "SELECT *, NULL FROM edge ORDER BY id");
    while (edges.step()) {
      map.apply(EdgeAdded{{{edges.integer(0)},
                           {edges.integer(1)},
                           {edges.integer(2)},
                           edges.real(3),
                           edges.real(4),
                           edges.real(5)}});
    }
  }
  catch (const LogicError &error) {
    damaged(database, error.what());
  }
  return map;
}

} // namespace homeward
