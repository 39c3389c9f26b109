// SPDX-License-Identifier: GPL-3.0-or-later
#include "map_tables.h"

#include <homeward/core/error.h>

#include <array>

namespace homeward
{

namespace
{

constexpr std::int64_t kApplicationId = 0x48774d70; // "HwMp" in the file's header
constexpr std::int64_t kSchemaVersion = 3;

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
  bearing_at_b_rad REAL) STRICT;
CREATE TABLE view(
  node INTEGER PRIMARY KEY REFERENCES node(id),
  hash TEXT NOT NULL,
  jpeg BLOB NOT NULL) STRICT;
CREATE TABLE run_log(seq INTEGER PRIMARY KEY, time_s REAL NOT NULL, line TEXT NOT NULL) STRICT;
)";

// What each version added to the one before; a new map is one of version 1 that went through all.
// Rows are written anew, since sessions see no defaults of columns that a row was stored without.
constexpr std::array<const char *, kSchemaVersion - 1> kSteps = {
    "ALTER TABLE edge ADD COLUMN length_m REAL",
    R"(
ALTER TABLE node ADD COLUMN name TEXT NOT NULL DEFAULT '';
ALTER TABLE edge ADD COLUMN tries INTEGER NOT NULL DEFAULT 0;
ALTER TABLE edge ADD COLUMN successes INTEGER NOT NULL DEFAULT 0;
ALTER TABLE edge ADD COLUMN mean_seconds REAL NOT NULL DEFAULT 0;
ALTER TABLE edge ADD COLUMN last_error TEXT NOT NULL DEFAULT '';
ALTER TABLE edge ADD COLUMN last_time_s REAL NOT NULL DEFAULT 0;
ALTER TABLE edge ADD COLUMN forbidden INTEGER NOT NULL DEFAULT 0 CHECK (forbidden IN (0, 1));
UPDATE node SET name = '';
UPDATE edge SET tries = 0;
CREATE TABLE next_id(kind TEXT PRIMARY KEY, id INTEGER NOT NULL) STRICT;
INSERT INTO next_id SELECT 'node', coalesce(max(id), -1) + 1 FROM node;
INSERT INTO next_id SELECT 'edge', coalesce(max(id), -1) + 1 FROM edge;
CREATE TABLE journal(
  number INTEGER PRIMARY KEY,
  description TEXT NOT NULL,
  undone INTEGER NOT NULL DEFAULT 0 CHECK (undone IN (0, 1)),
  changeset BLOB NOT NULL) STRICT;
)"};

void setVersion(Database &database, std::int64_t version)
{
  database.execute(("PRAGMA user_version = " + std::to_string(version)).c_str());
}

void takeSteps(Database &database, std::int64_t version)
{
  for (; version < kSchemaVersion; ++version) {
    database.execute(kSteps.at(static_cast<std::size_t>(version - 1)));
  }
  setVersion(database, kSchemaVersion);
}

} // namespace

void damaged(const Database &database, const std::string &why)
{
  throw StoreError("map " + database.file().string() + " is damaged (" + why +
                   "); use a copy of it");
}

void createTables(Database &database)
{
  database.execute(kTables);
  database.execute(("PRAGMA application_id = " + std::to_string(kApplicationId)).c_str());
  takeSteps(database, 1);
}

std::int64_t tableVersion(Database &database)
{
  return database.integer("PRAGMA user_version");
}

void checkVersion(Database &database)
{
  const std::string file = database.file().string();
  if (database.integer("PRAGMA application_id") != kApplicationId) {
    throw StoreError("map " + file +
                     " is not a Homeward map; give a file that `homeward explore` wrote");
  }
  const std::int64_t version = tableVersion(database);
  if (version > kSchemaVersion) {
    throw StoreError("map " + file + " has version " + std::to_string(version) +
                     ", this program reads up to " + std::to_string(kSchemaVersion) +
                     "; use a newer Homeward");
  }
  if (version < 1) {
    damaged(database, "version " + std::to_string(version));
  }
}

std::vector<std::string> tableFindings(Database &database)
{
  std::vector<std::string> findings;
  Statement pages(database, "PRAGMA integrity_check");
  while (pages.step()) {
    const std::string report = pages.text(0);
    if (report != "ok") {
      findings.push_back(report.substr(report.find_last_of('\n') + 1));
    }
  }
  Statement orphans(database, "PRAGMA foreign_key_check");
  while (orphans.step()) {
    findings.push_back("table " + orphans.text(0) + ", row " + orphans.text(1) +
                       ", names a place that is not there");
  }
  return findings;
}

void migrateTables(Database &database)
{
  const std::int64_t version = tableVersion(database);
  if (version == kSchemaVersion) {
    return;
  }
  Transaction transaction(database);
  takeSteps(database, version);
  transaction.commit();
}

} // namespace homeward
