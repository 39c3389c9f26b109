// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/store/view_codec.h>
#include <homeward/topology/map.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace homeward
{

class Database;

/** What a map was made with. Written once, when the map is created. */
struct MapHeader
{
  std::string cameraHash;                   ///< contentHashText() of the camera file's text
  PanoramaGeometry panorama;                ///< of every picture in it
  std::string signatureKind;                ///< which signature tells the places apart
  int signatureVersion = 1;                 ///< see kSignatureVersion
  std::map<std::string, double> thresholds; ///< by name; each with its own unit

  bool operator==(const MapHeader &) const = default;
};

/** The picture of a place. */
struct NewView
{
  NodeId node;     ///< that it shows
  ViewBytes bytes; ///< from encodeView()
};

/** A line of the run log. */
struct LogLine
{
  double time = 0.0; ///< robot time, seconds
  std::string text;  ///< for people

  bool operator==(const LogLine &) const = default;
};

/** All that one step changes in a map, in one transaction. */
struct MapUpdate
{
  std::vector<MapChange> changes = {};        ///< of the graph, in this order
  std::optional<NewView> view = std::nullopt; ///< of a node that has none
  /** Newer pictures of nodes that have one, turned to the heading that the node was stored with. */
  std::vector<NewView> refreshes = {};
  std::vector<LogLine> log = {};                  ///< lines to add
  std::map<std::string, std::string> values = {}; ///< free keys; an old value is replaced
};

/** An edit that the file remembers and can take back. */
struct JournalEntry
{
  std::int64_t number = 0; ///< counts from 1
  std::string description; ///< for people, one line
  bool undone = false;     ///< it was taken back

  bool operator==(const JournalEntry &) const = default;
};

/**
 * A map on disk: one SQLite file with the graph, each place's picture, the header and the run log.
 *
 * Every append(), edit() and undo() is one transaction: after a crash, a full disk or any other
 * failure the file holds all of an update or nothing of it. A new map is built under the name
 * `<file>.part` and gets its own name only when its first place is safely in it: until then an
 * older map of that name stays, and no map without a place or without a header can ever be found
 * there.
 *
 * One program writes, others may read at the same time (SQLite's write-ahead log). close() folds
 * the log in, so that one plain file remains. Not for use from two threads at once.
 */
class MapFile
{
public:
  /** What becomes of an older map of the same name. */
  enum class IfExists
  {
    Refuse,
    Replace
  };
  /** What the map is opened for. */
  enum class Access
  {
    ReadWrite,
    Read
  };

  /**
   * Starts a new map.
   * @param path its name; conventionally `.hwm`
   * @throw StoreError when the file exists and may not be replaced, the folder is missing, or it
   * cannot be written
   */
  static MapFile create(const std::filesystem::path &path, const MapHeader &header,
                        IfExists ifExists = IfExists::Refuse);

  /**
   * Starts a new map with all that another holds now, brought to today's version. It gets its name
   * with the first append(); the other stays as it is. Throws as create().
   */
  static MapFile copyOf(const MapFile &original, const std::filesystem::path &path,
                        IfExists ifExists = IfExists::Refuse);

  /**
   * Opens a map, checks the whole file and loads the graph.
   * @throw StoreError, in one line, when the file is missing, not a map, damaged, or was made by a
   * newer version
   */
  static MapFile open(const std::filesystem::path &path, Access access = Access::ReadWrite);

  MapFile(MapFile &&other) noexcept;
  MapFile &operator=(MapFile &&other) = delete;

  /** Closes; what fails then is lost, call close() to hear of it. */
  ~MapFile();

  /** Its name. */
  const std::filesystem::path &path() const { return m_path; }
  /** What it was made with. */
  const MapHeader &header() const { return m_header; }

  /** The graph, as of the last append(). */
  const TopologicalMap &map() const { return m_map; }

  /**
   * Makes all of an update, or nothing. What is removed takes its picture along.
   * @throw LogicError when a change breaks a rule of TopologicalMap, the view's node is unknown or
   * has a view already, a refreshed one has none, the file was opened for reading or is closed;
   * nothing is written then
   * @throw StoreError when it cannot be written, or another program wrote since it was opened; the
   * map stays as it was
   */
  void append(const MapUpdate &update);

  /** As append(), of several one after the other: all of them or nothing. */
  void append(const std::vector<MapUpdate> &updates);

  /**
   * As append(), and the file remembers how to take it back.
   * @param description for people, one line
   * @return its number in the journal
   */
  std::int64_t edit(const std::string &description, const MapUpdate &update);

  /**
   * Takes back the newest edit that was not undone yet; removed nodes come back with their
   * pictures.
   * @throw StoreError when there is none, or when what it changed was changed again since; the map
   * stays as it was
   */
  JournalEntry undo();

  /** Every edit, oldest first. @throw StoreError */
  std::vector<JournalEntry> journal() const;

  /** How many times pictures were replaced or removed since the file was opened. */
  std::int64_t pictureChanges() const { return m_pictureChanges; }

  /** Whether the node has a picture. */
  bool hasView(NodeId node) const;

  /**
   * The stored bytes of a node's picture.
   * @throw LogicError when the node has none; StoreError when they cannot be read or are damaged
   */
  ViewBytes view(NodeId node) const;

  /** The decoded picture of a node, with the header's geometry. Throws as view(). */
  Panorama panorama(NodeId node) const;

  /** The run log, oldest first. @throw StoreError */
  std::vector<LogLine> log() const;

  /** A value of MapUpdate::values, or nothing. @throw StoreError */
  std::optional<std::string> value(std::string_view key) const;

  /**
   * Refuses a map that was made with another camera or panorama than `wanted`. Signatures may
   * differ: they are made anew from the views.
   * @throw StoreError naming both values
   */
  void expectMadeWith(const MapHeader &wanted) const;

  /** Folds the write-ahead log in and closes. A map without a place leaves no file. @throw
   * StoreError */
  void close();

private:
  MapFile(std::filesystem::path path, std::unique_ptr<Database> database);

  Database &database() const;
  void load();
  void beginWriting();
  void expectWritable() const;
  TopologicalMap changed(const TopologicalMap &map, const MapUpdate &update) const;
  void expectOwn() const;
  void write(const MapUpdate &update, const TopologicalMap &before, const TopologicalMap &after);
  std::int64_t writeEdit(const std::string &description, const MapUpdate &update,
                         const TopologicalMap &grown);
  std::pair<JournalEntry, std::vector<unsigned char>> newestEdit() const;
  void finish(TopologicalMap grown);
  void publish();

  std::filesystem::path m_path;
  std::unique_ptr<Database> m_database; ///< null once closed
  Access m_access = Access::ReadWrite;
  IfExists m_ifExists = IfExists::Refuse;
  bool m_published = true;        ///< false while it is still `<file>.part`
  std::int64_t m_dataVersion = 0; ///< changes when another program writes
  std::int64_t m_pictureChanges = 0;
  MapHeader m_header;
  TopologicalMap m_map;
};

} // namespace homeward
