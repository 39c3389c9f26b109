// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/store/map_file.h>

#include "change_recorder.h"
#include "database.h"
#include "map_rows.h"
#include "map_tables.h"
#include "number_text.h"

#include <homeward/core/error.h>
#include <homeward/store/content_hash.h>

#include <algorithm>
#include <cmath>

namespace homeward
{

namespace
{

namespace fs = std::filesystem;

fs::path withSuffix(const fs::path &path, const char *suffix)
{
  fs::path longer = path;
  longer += suffix;
  return longer;
}

fs::path partOf(const fs::path &path)
{
  return withSuffix(path, ".part");
}

void removeQuietly(const fs::path &path) noexcept
{
  std::error_code ignored;
  fs::remove(path, ignored);
}

void refuseExisting(const fs::path &path, MapFile::IfExists ifExists)
{
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) {
    throw StoreError("map " + path.string() + " is a folder; give a file name");
  }
  if (ifExists == MapFile::IfExists::Refuse && fs::exists(path, ignored)) {
    throw StoreError("map " + path.string() +
                     " exists already; give another name, or ask for it to be replaced");
  }
}

void refuseBadName(const fs::path &file, MapFile::IfExists ifExists)
{
  refuseExisting(file, ifExists);
  if (!fs::is_directory(file.parent_path())) {
    throw StoreError("map " + file.string() + " cannot be made: there is no folder " +
                     file.parent_path().string() + "; make it first");
  }
}

void checkHeader(const MapHeader &header)
{
  if (header.panorama.width < 1 || header.panorama.height < 1) {
    throw LogicError("map header: panorama of " + std::to_string(header.panorama.width) + " x " +
                     std::to_string(header.panorama.height) + " pixels");
  }
  if (header.signatureVersion < 1) {
    throw LogicError("map header: signature version " + std::to_string(header.signatureVersion) +
                     ", they count from 1");
  }
  for (const auto &[key, value] : header.thresholds) {
    if (!std::isfinite(value)) {
      throw LogicError("map header: threshold " + key + " is not finite");
    }
  }
}

void checkLog(const std::vector<LogLine> &lines)
{
  for (const LogLine &line : lines) {
    if (!std::isfinite(line.time)) {
      throw LogicError("run log: the time of \"" + line.text + "\" is not finite");
    }
  }
}

bool takesPicturesAway(const MapUpdate &update)
{
  return !update.refreshes.empty() ||
         std::any_of(update.changes.begin(), update.changes.end(), [](const MapChange &change) {
           return std::holds_alternative<NodeRemoved>(change) ||
                  std::holds_alternative<NodesMerged>(change);
         });
}

std::string sizeText(const PanoramaGeometry &geometry)
{
  return std::to_string(geometry.width) + " x " + std::to_string(geometry.height) + " from " +
         exactText(degrees(geometry.elevationMin)) + " to " +
         exactText(degrees(geometry.elevationMax)) + " deg";
}

void expectSame(const fs::path &path, const std::string &what, const std::string &stored,
                const std::string &wanted)
{
  if (stored != wanted) {
    throw StoreError("map " + path.string() + " was made with " + what + " " + stored + ", not " +
                     wanted + "; use the same again, or make a new map");
  }
}

} // namespace

MapFile::MapFile(fs::path path, std::unique_ptr<Database> database)
    : m_path(std::move(path)), m_database(std::move(database))
{}

MapFile::MapFile(MapFile &&other) noexcept = default;

MapFile::~MapFile()
{
  try {
    close();
  }
  catch (const std::exception &) { // NOLINT(bugprone-empty-catch): documented at the destructor
  }
}

MapFile MapFile::create(const fs::path &path, const MapHeader &header, IfExists ifExists)
{
  checkHeader(header);
  const fs::path file = fs::absolute(path);
  refuseBadName(file, ifExists);
  auto database = std::make_unique<Database>(partOf(file), Database::Mode::Create);
  // Alone from the first lock to the rename: a second program that starts the same map is refused.
  database->execute("PRAGMA locking_mode = EXCLUSIVE");
  database->reset(); // what a run that was killed has left
  MapFile created(file, std::move(database));
  created.m_published = false;
  created.m_ifExists = ifExists;
  created.m_header = header;
  {
    Transaction transaction(created.database());
    createTables(created.database());
    writeHeader(created.database(), header);
    transaction.commit();
  }
  created.m_dataVersion = created.database().integer("PRAGMA data_version");
  return created;
}

MapFile MapFile::copyOf(const MapFile &original, const fs::path &path, IfExists ifExists)
{
  const fs::path file = fs::absolute(path);
  refuseBadName(file, ifExists);
  removeQuietly(partOf(file));
  {
    const MayWrite elsewhere(original.database());
    Statement(original.database(), "VACUUM INTO ?")
        .bind(std::string_view(partOf(file).string()))
        .run();
  }
  MapFile copy(file, std::make_unique<Database>(partOf(file), Database::Mode::ReadWrite));
  copy.m_published = false;
  copy.m_ifExists = ifExists;
  copy.database().execute("PRAGMA locking_mode = EXCLUSIVE");
  copy.load();
  migrateTables(copy.database());
  copy.m_dataVersion = copy.database().integer("PRAGMA data_version");
  return copy;
}

MapFile MapFile::open(const fs::path &path, Access access)
{
  const fs::path file = fs::absolute(path);
  if (!fs::exists(file)) {
    throw StoreError("map " + file.string() +
                     " does not exist; give a file that `homeward "
                     "explore` wrote");
  }
  if (fs::is_directory(file)) {
    throw StoreError("map " + file.string() + " is a folder; give a file name");
  }
  const auto mode = access == Access::Read ? Database::Mode::Read : Database::Mode::ReadWrite;
  MapFile opened(file, std::make_unique<Database>(file, mode));
  opened.m_access = access;
  opened.load();
  if (access == Access::ReadWrite) {
    opened.beginWriting();
    migrateTables(*opened.m_database);
  }
  return opened;
}

void MapFile::load()
{
  checkVersion(*m_database);
  if (const std::vector<std::string> findings = tableFindings(*m_database); !findings.empty()) {
    damaged(*m_database, findings.front());
  }
  m_header = readHeader(*m_database);
  m_map = readMap(*m_database);
}

void MapFile::beginWriting()
{
  m_database->execute("PRAGMA foreign_keys = ON");
  m_database->execute("PRAGMA journal_mode = WAL");
  m_database->execute("PRAGMA synchronous = FULL");
  m_dataVersion = m_database->integer("PRAGMA data_version");
}

Database &MapFile::database() const
{
  if (!m_database) {
    throw LogicError("map " + m_path.string() + " is closed");
  }
  return *m_database;
}

void MapFile::expectWritable() const
{
  if (m_access == Access::Read) {
    throw LogicError("map " + m_path.string() + " was opened for reading only");
  }
  database();
}

TopologicalMap MapFile::changed(const TopologicalMap &map, const MapUpdate &update) const
{
  expectWritable();
  checkLog(update.log);
  TopologicalMap grown = map;
  for (const MapChange &change : update.changes) {
    grown.apply(change);
  }
  const auto checkView = [&](const NewView &view) {
    grown.node(view.node);
    decodeView(view.bytes, m_header.panorama);
  };
  if (update.view) {
    checkView(*update.view);
  }
  std::for_each(update.refreshes.begin(), update.refreshes.end(), checkView);
  return grown;
}

void MapFile::append(const MapUpdate &update)
{
  append(std::vector<MapUpdate>{update});
}

void MapFile::append(const std::vector<MapUpdate> &updates)
{
  expectWritable();
  Transaction transaction(database());
  expectOwn();
  TopologicalMap grown = m_map;
  bool picturesGone = false;
  for (const MapUpdate &update : updates) {
    TopologicalMap next = changed(grown, update);
    write(update, grown, next);
    grown = std::move(next);
    picturesGone = picturesGone || takesPicturesAway(update);
  }
  transaction.commit();
  m_pictureChanges += picturesGone ? 1 : 0;
  finish(std::move(grown));
}

std::int64_t MapFile::edit(const std::string &description, const MapUpdate &update)
{
  TopologicalMap grown = changed(m_map, update);
  Transaction transaction(database());
  expectOwn();
  const std::int64_t number = writeEdit(description, update, grown);
  if (readMap(database()) != grown) {
    throw LogicError("map " + m_path.string() + ": the rows of \"" + description +
                     "\" say something else");
  }
  transaction.commit();
  m_pictureChanges += takesPicturesAway(update) ? 1 : 0;
  finish(std::move(grown));
  return number;
}

std::int64_t MapFile::writeEdit(const std::string &description, const MapUpdate &update,
                                const TopologicalMap &grown)
{
  const ChangeRecorder recorder(database());
  write(update, m_map, grown);
  Statement(database(), "INSERT INTO journal(description, changeset) VALUES (?, ?)")
      .bind(std::string_view(description))
      .bind(std::span<const unsigned char>(recorder.changes()))
      .run();
  return database().integer("SELECT max(number) FROM journal");
}

JournalEntry MapFile::undo()
{
  expectWritable();
  Transaction transaction(database());
  expectOwn();
  const auto [entry, changes] = newestEdit();
  const std::string conflict = "map " + m_path.string() + ": edit " + std::to_string(entry.number) +
                               " (" + entry.description +
                               ") cannot be undone, the map has changed there since";
  if (!takeBack(database(), changes)) {
    throw StoreError(conflict);
  }
  TopologicalMap before;
  try {
    before = readMap(database());
  }
  catch (const StoreError &) {
    throw StoreError(conflict);
  }
  Statement(database(), "UPDATE journal SET undone = 1 WHERE number = ?").bind(entry.number).run();
  transaction.commit();
  m_map = std::move(before);
  ++m_pictureChanges;
  return entry;
}

std::pair<JournalEntry, std::vector<unsigned char>> MapFile::newestEdit() const
{
  Statement newest(database(), "SELECT number, description, changeset FROM journal"
                               " WHERE undone = 0 ORDER BY number DESC LIMIT 1");
  if (!newest.step()) {
    throw StoreError("map " + m_path.string() + " has no edit to undo");
  }
  return {{newest.integer(0), newest.text(1), true}, newest.blob(2)};
}

std::vector<JournalEntry> MapFile::journal() const
{
  std::vector<JournalEntry> entries;
  if (tableVersion(database()) < 3) {
    return entries;
  }
  Statement rows(database(), "SELECT number, description, undone FROM journal ORDER BY number");
  while (rows.step()) {
    entries.push_back({rows.integer(0), rows.text(1), rows.integer(2) != 0});
  }
  return entries;
}

void MapFile::expectOwn() const
{
  if (database().integer("PRAGMA data_version") != m_dataVersion) {
    throw StoreError("map " + m_path.string() +
                     " was changed by another program; open it again to go on");
  }
}

void MapFile::write(const MapUpdate &update, const TopologicalMap &before,
                    const TopologicalMap &after)
{
  Database &file = database();
  writeDifference(file, before, after);
  if (update.view) {
    if (hasView(update.view->node)) {
      throw LogicError("map " + m_path.string() + ": node " +
                       std::to_string(update.view->node.value) + " has a view already");
    }
    writeView(file, *update.view);
  }
  for (const NewView &view : update.refreshes) {
    if (!hasView(view.node)) {
      throw LogicError("map " + m_path.string() + ": node " + std::to_string(view.node.value) +
                       " has no view to refresh");
    }
    replaceView(file, view);
  }
  writeLog(file, update.log);
  writeValues(file, update.values);
}

void MapFile::finish(TopologicalMap grown)
{
  if (!m_published && !grown.nodes().empty()) {
    publish();
  }
  m_map = std::move(grown);
}

void MapFile::publish()
{
  // SQLite forbids renaming an open file.
  m_database->close();
  m_database.reset();
  try {
    refuseExisting(m_path, m_ifExists);
    // A log that a crash left to the map that is replaced must not be read into the new one.
    fs::remove(withSuffix(m_path, "-wal"));
    fs::remove(withSuffix(m_path, "-shm"));
    fs::rename(partOf(m_path), m_path);
  }
  catch (const fs::filesystem_error &error) {
    removeQuietly(partOf(m_path));
    throw StoreError("map " + m_path.string() + " cannot get its name (" + error.code().message() +
                     "); check the permissions of its folder");
  }
  catch (const StoreError &) {
    removeQuietly(partOf(m_path));
    throw;
  }
  m_published = true;
  m_database = std::make_unique<Database>(m_path, Database::Mode::ReadWrite);
  beginWriting();
}

bool MapFile::hasView(NodeId node) const
{
  Statement rows(database(), "SELECT 1 FROM view WHERE node = ?");
  return rows.bind(node.value).step();
}

ViewBytes MapFile::view(NodeId node) const
{
  Statement rows(database(), "SELECT jpeg, hash FROM view WHERE node = ?");
  if (!rows.bind(node.value).step()) {
    throw LogicError("map " + m_path.string() + ": node " + std::to_string(node.value) +
                     " has no view");
  }
  ViewBytes bytes = rows.blob(0);
  if (hashText(contentHash(bytes)) != rows.text(1)) {
    throw StoreError("map " + m_path.string() + " is damaged (the view of node " +
                     std::to_string(node.value) + " changed); use a copy of it");
  }
  return bytes;
}

Panorama MapFile::panorama(NodeId node) const
{
  try {
    return decodeView(view(node), m_header.panorama);
  }
  catch (const StoreError &) {
    throw;
  }
  catch (const RuntimeError &error) {
    throw StoreError("map " + m_path.string() + " is damaged (node " + std::to_string(node.value) +
                     ", " + error.what() + "); use a copy of it");
  }
}

std::vector<LogLine> MapFile::log() const
{
  std::vector<LogLine> lines;
  Statement rows(database(), "SELECT time_s, line FROM run_log ORDER BY seq");
  while (rows.step()) {
    lines.push_back({rows.real(0).value_or(0.0), rows.text(1)});
  }
  return lines;
}

std::optional<std::string> MapFile::value(std::string_view key) const
{
  Statement rows(database(), "SELECT value FROM value WHERE key = ?");
  if (!rows.bind(key).step()) {
    return std::nullopt;
  }
  return rows.text(0);
}

void MapFile::expectMadeWith(const MapHeader &wanted) const
{
  expectSame(m_path, "camera", m_header.cameraHash, wanted.cameraHash);
  expectSame(m_path, "panoramas of", sizeText(m_header.panorama), sizeText(wanted.panorama));
}

void MapFile::close()
{
  if (!m_database) {
    return;
  }
  const std::unique_ptr<Database> closing = std::move(m_database);
  if (!m_published) {
    closing->close();
    removeQuietly(partOf(m_path));
    return;
  }
  if (m_access == Access::ReadWrite) {
    // Back to a plain file that needs no companions, readable from a read-only disk too. It fails
    // while others read; then the log is folded in when the last of them closes.
    try {
      closing->execute("PRAGMA journal_mode = DELETE");
    }
    catch (const StoreError &) {
      closing->execute("PRAGMA wal_checkpoint");
    }
  }
  closing->close();
}

} // namespace homeward
