// SPDX-License-Identifier: GPL-3.0-or-later
#include "store_fixture.h"

#include <homeward/store/export.h>
#include <homeward/store/map_check.h>

#include "test_paths.h"
#include "xml.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <sqlite3.h>

#include <fstream>

namespace homeward
{
namespace
{

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

std::string contentsOf(const std::filesystem::path &path)
{
  std::ifstream file(path);
  EXPECT_TRUE(file.good()) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

/** SQL statements on the file, with none of the module's care. */
void meddle(const std::filesystem::path &path, const std::string &sql)
{
  sqlite3 *database = nullptr;
  EXPECT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
  EXPECT_EQ(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK)
      << sqlite3_errmsg(database);
  EXPECT_EQ(sqlite3_close(database), SQLITE_OK);
}

class ExportTest : public StoreTest
{
protected:
  /** Builds a map file from the SQL text of tests/golden/store. */
  void makeGolden(const std::string &name) const
  {
    std::filesystem::remove(path());
    meddle(path(), contentsOf(goldenDir() / "store" / (name + ".sql")));
  }

  /** What tests/golden/store says of exportCanonical(), its origin apart. */
  static std::string goldenText(const std::string &name)
  {
    const std::string text = contentsOf(goldenDir() / "store" / (name + ".canonical"));
    return text.substr(text.find('\n') + 1);
  }
};

TEST_F(ExportTest, OldFilesAreStillRead)
{
  for (const auto &[name, nodes] : {std::pair{"map_v1", 3U}, std::pair{"map_v2", 4U}}) {
    makeGolden(name);
    const MapFile file = MapFile::open(path());
    EXPECT_EQ(file.header(), smallHeader());
    EXPECT_EQ(file.map().nodes().size(), nodes);
    EXPECT_EQ(file.map().nextNodeId(), NodeId{nodes});
    EXPECT_EQ(file.log().size(), nodes);
    EXPECT_EQ(file.value("at_node"), "2");
    EXPECT_EQ(file.map().edge({0}).statistics, EdgeStatistics{});
    EXPECT_FALSE(file.map().edge({0}).length);
    EXPECT_LE(cv::norm(file.panorama({2}).image, smallPanorama(2).image, cv::NORM_L1) / 256, 12.0);
  }
}

TEST_F(ExportTest, OldFilesThatAreWrittenToBecomeOnesOfToday)
{
  for (const std::string name : {"map_v1", "map_v2"}) {
    makeGolden(name);
    const TopologicalMap before = MapFile::open(path(), MapFile::Access::Read).map();
    TopologicalMap after = before;
    {
      MapFile file = MapFile::open(path());
      const std::vector<MapChange> changes = {
          NodeAdded{{after.nextNodeId(), {}, "hall"}},
          EdgeAdded{{after.nextEdgeId(), {2}, after.nextNodeId(), 0.1, 0.2, 1.9}},
          EdgeTried{{0}, "", 9.0, 1.0}, EdgeForbidden{{1}}};
      file.append({.changes = changes});
      for (const MapChange &change : changes) {
        after.apply(change);
      }
      file.edit("delete node 0", {.changes = {NodeRemoved{{0}}}});
      EXPECT_EQ(file.undo().description, "delete node 0");
    }
    EXPECT_EQ(MapFile::open(path(), MapFile::Access::Read).map(), after);
  }
}

TEST_F(ExportTest, OldFilesAreReadWithoutBeingTouched)
{
  for (const std::string name : {"map_v1", "map_v2"}) {
    makeGolden(name);
    const std::string before = contentsOf(path());
    const auto file = MapFile::open(path(), MapFile::Access::Read);
    EXPECT_EQ(exportCanonical(file), goldenText(name));
    EXPECT_TRUE(file.journal().empty());
    EXPECT_TRUE(checkMap(path()).findings.empty());
    EXPECT_EQ(contentsOf(path()), before);
  }
}

TEST_F(ExportTest, CanonicalTextIsTheGoldenOne)
{
  for (const std::string name : {"map_v1", "map_v2"}) {
    makeGolden(name);
    EXPECT_EQ(exportCanonical(MapFile::open(path())), goldenText(name));
  }
}

/** As fill(), with a name, a no-go way, and one that was tried. */
MapFile usedMap(const std::filesystem::path &path)
{
  auto file = MapFile::create(path, smallHeader());
  fill(file);
  file.append({.changes = {NodeNamed{{0}, "the \"lab\" <1>"}, NodeNamed{{1}, "hall"},
                           EdgeTried{{1}, "", 12.5, 1.7e9}, EdgeTried{{1}, "lost", 3.0, 1.8e9},
                           EdgeForbidden{{0}}}});
  return file;
}

TEST_F(ExportTest, CanonicalTextHasNamesAndUseButNoTimeOfDay)
{
  const std::string text = exportCanonical(usedMap(path()));
  EXPECT_THAT(text, HasSubstr("\nnode 0 view 1aeea15242bb467c name \"the \\\"lab\\\" <1>\"\n"));
  EXPECT_THAT(text, HasSubstr("\nedge 0 0 1 0.500000 -2.000000 unknown forbidden\n"));
  EXPECT_THAT(text, HasSubstr("\nedge 1 2 1 1.500000 unknown unknown tried 2 arrived 1 mean "
                              "12.500000 last \"lost\"\n"));
}

TEST_F(ExportTest, OtherFormsHaveNamesAndUse)
{
  const auto file = usedMap(path());
  const nlohmann::json json = nlohmann::json::parse(exportJson(file));
  EXPECT_EQ(json["nodes"][0]["name"], "the \"lab\" <1>");
  EXPECT_EQ(json["edges"][1]["tries"], 2);
  EXPECT_EQ(json["edges"][1]["successes"], 1);
  EXPECT_EQ(json["edges"][1]["mean_s"], 12.5);
  EXPECT_EQ(json["edges"][1]["last_error"], "lost");
  EXPECT_EQ(json["edges"][1]["last_time_s"], 1.8e9);
  EXPECT_EQ(json["edges"][0]["forbidden"], true);

  const std::string graphml = exportGraphml(file.map());
  tinyxml2::XMLDocument document;
  ASSERT_EQ(document.Parse(graphml.c_str()), tinyxml2::XML_SUCCESS);
  EXPECT_THAT(graphml, HasSubstr("<data key=\"name\">the &quot;lab&quot; &lt;1&gt;</data>"));
  EXPECT_THAT(graphml, HasSubstr("<data key=\"forbidden\">true</data>"));
  EXPECT_THAT(graphml, HasSubstr("<data key=\"mean\">12.500000</data>"));

  const std::string dot = exportDot(file.map());
  EXPECT_THAT(dot, HasSubstr("  0 [peripheries=2, label=\"the \\\"lab\\\" <1>\"];\n"));
  EXPECT_THAT(dot, HasSubstr("  1 [label=\"hall\"];\n"));
  EXPECT_THAT(dot, HasSubstr("  0 -- 1 [style=dashed, color=red];\n"));
}

TEST_F(ExportTest, CanonicalTextTellsMapsApartButNotRuns)
{
  const auto grow = [](MapFile &file, double time, double bearing, int seed) {
    file.append({.changes = {NodeAdded{{{0}, {{{0}, bearing, 0.25}}}}},
                 .view = NewView{{0}, encodeView(smallPanorama(seed))},
                 .log = {{time, "start"}}});
    return exportCanonical(file);
  };
  const auto text = [&](double time, double bearing, int seed) {
    auto file = MapFile::create(path(), smallHeader(), MapFile::IfExists::Replace);
    return grow(file, time, bearing, seed);
  };
  const std::string first = text(1.0, 0.5, 3);
  EXPECT_EQ(text(2.0, 0.5, 3), first);
  EXPECT_EQ(text(1.0, 0.5 + 1e-8, 3), first);
  EXPECT_NE(text(1.0, 0.6, 3), first);
  EXPECT_NE(text(1.0, 0.5, 4), first);
  EXPECT_THAT(text(1.0, -1e-9, 3), HasSubstr("direction 0 0 0.000000 0.250000 open \"\""));
}

TEST_F(ExportTest, JsonHoldsTheWholeMap)
{
  auto file = MapFile::create(path(), smallHeader());
  fill(file);
  file.append({.changes = {NodeAdded{
                   {{3}, {{{0}, 0.0, 0.1, DirectionState::Closed, "\"quoted\"\n\xff"}}}}}});
  const nlohmann::json json = nlohmann::json::parse(exportJson(file));
  EXPECT_EQ(json["schema"], "homeward-map-1");
  EXPECT_EQ(json["header"]["panorama"]["width"], 32);
  EXPECT_EQ(json["header"]["thresholds"]["same_place"], 0.125);
  ASSERT_EQ(json["nodes"].size(), 4U);
  EXPECT_EQ(json["nodes"][1]["directions"][1]["bearing_rad"].get<double>(), -1.0 / 3.0);
  EXPECT_EQ(json["nodes"][1]["directions"][1]["state"], "closed");
  EXPECT_EQ(json["nodes"][1]["view_hash"].get<std::string>().size(), 16U);
  EXPECT_TRUE(json["nodes"][3]["view_hash"].is_null());
  EXPECT_EQ(json["edges"][1]["a"], 2);
  EXPECT_EQ(json["edges"][0]["bearing_at_b_rad"], -2.0);
  EXPECT_TRUE(json["edges"][1]["bearing_at_b_rad"].is_null());
}

TEST_F(ExportTest, GraphmlIsWellFormedWhateverTheReasons)
{
  TopologicalMap map;
  map.apply(NodeAdded{{{0}, {{{0}, 0.0, 0.1, DirectionState::Closed, "a < b & \"c\"\x01"}}}});
  map.apply(NodeAdded{{{1}, {{{0}, 1.0, 0.1}, {{1}, 2.0, 0.1}}}});
  map.apply(EdgeAdded{{{0}, {0}, {1}, 0.5, std::nullopt}});

  tinyxml2::XMLDocument document;
  ASSERT_EQ(document.Parse(exportGraphml(map).c_str()), tinyxml2::XML_SUCCESS);
  const tinyxml2::XMLElement *graph = document.RootElement()->FirstChildElement("graph");
  ASSERT_NE(graph, nullptr);
  EXPECT_EQ(childCount(*graph, "node"), 2);
  ASSERT_EQ(childCount(*graph, "edge"), 1);
  const tinyxml2::XMLElement *edge = graph->FirstChildElement("edge");
  EXPECT_STREQ(edge->Attribute("source"), "n0");
  EXPECT_STREQ(edge->Attribute("target"), "n1");
  EXPECT_EQ(edge->FirstChildElement("data")->DoubleText(), 0.5);
  EXPECT_THAT(exportGraphml(map), HasSubstr("0.000000 closed (a &lt; b &amp; &quot;c&quot; )"));
  EXPECT_THAT(exportGraphml(map), HasSubstr("<data key=\"open\">2</data>"));
}

TEST_F(ExportTest, DotNamesPlacesAndWays)
{
  auto file = MapFile::create(path(), smallHeader());
  fill(file);
  EXPECT_EQ(exportDot(file.map()), "graph map {\n"
                                   "  node [shape=circle];\n"
                                   "  0 [peripheries=2];\n"
                                   "  1;\n"
                                   "  2 [peripheries=2];\n"
                                   "  0 -- 1;\n"
                                   "  2 -- 1;\n"
                                   "}\n");
}

} // namespace
} // namespace homeward
