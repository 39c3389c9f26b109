// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/store/map_check.h>

#include "map_rows.h"
#include "map_tables.h"

#include <homeward/core/error.h>
#include <homeward/store/content_hash.h>

#include <algorithm>
#include <optional>

namespace homeward
{

namespace
{

class Checker
{
public:
  explicit Checker(const std::filesystem::path &path) : m_prefix("map " + path.string() + ": ")
  {
    if (!std::filesystem::is_regular_file(path)) {
      note("there is no such file");
      return;
    }
    attempt([&] {
      Database database(path, Database::Mode::Read);
      checkVersion(database);
      look(database);
    });
  }

  MapCheck result() { return std::move(m_result); }

private:
  /** What a step throws is a finding. */
  template <class Step> void attempt(const Step &step)
  {
    try {
      step();
    }
    catch (const StoreError &error) {
      m_result.findings.emplace_back(error.what());
    }
  }

  void note(const std::string &finding) { m_result.findings.push_back(m_prefix + finding); }

  void look(Database &database)
  {
    attempt([&] {
      for (const std::string &finding : tableFindings(database)) {
        note(finding);
      }
    });
    attempt([&] {
      const TopologicalMap map = readMap(database);
      m_result.nodes = map.nodes().size();
      m_result.edges = map.edges().size();
    });
    attempt([&] { lookAtPictures(database, readHeader(database).panorama); });
  }

  void lookAtPictures(Database &database, const PanoramaGeometry &geometry)
  {
    Statement rows(database, "SELECT node.id, view.hash, view.jpeg FROM node"
                             " LEFT JOIN view ON view.node = node.id ORDER BY node.id");
    while (rows.step()) {
      const std::string flaw = pictureFlaw(rows.text(1), rows.blob(2), geometry);
      if (flaw.empty()) {
        ++m_result.pictures;
      }
      else {
        note("node " + std::to_string(rows.integer(0)) + " " + flaw);
      }
    }
  }

  /** Empty: the picture is sound. */
  static std::string pictureFlaw(const std::string &hash, const ViewBytes &bytes,
                                 const PanoramaGeometry &geometry)
  {
    if (hash.empty()) {
      return "has no picture";
    }
    if (hashText(contentHash(bytes)) != hash) {
      return "has a picture that changed since it was stored";
    }
    try {
      decodeView(bytes, geometry);
      return "";
    }
    catch (const RuntimeError &error) {
      return std::string("has no panorama: ") + error.what();
    }
  }

  std::string m_prefix;
  MapCheck m_result;
};

} // namespace

MapCheck checkMap(const std::filesystem::path &path)
{
  return Checker(std::filesystem::absolute(path)).result();
}

} // namespace homeward
