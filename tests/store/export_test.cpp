// SPDX-License-Identifier: GPL-3.0-or-later
#include "store_fixture.h"

#include <homeward/store/export.h>

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

class ExportTest : public StoreTest
{
protected:
  /** Builds a map file from the SQL text of tests/golden/store. */
  MapFile golden() const
  {
    const std::string sql = contentsOf(goldenDir() / "store" / "map_v1.sql");
    sqlite3 *database = nullptr;
    EXPECT_EQ(sqlite3_open(path().c_str(), &database), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK)
        << sqlite3_errmsg(database);
    EXPECT_EQ(sqlite3_close(database), SQLITE_OK);
    return MapFile::open(path());
  }
};

TEST_F(ExportTest, AVersion1FileIsStillRead)
{
  const MapFile file = golden();
  EXPECT_EQ(file.header(), smallHeader());
  EXPECT_EQ(file.map().nodes().size(), 3U);
  EXPECT_EQ(file.log().size(), 3U);
  EXPECT_EQ(file.value("at_node"), "2");
  EXPECT_LE(cv::norm(file.panorama({2}).image, smallPanorama(2).image, cv::NORM_L1) / 256, 12.0);
}

TEST_F(ExportTest, AVersion1FileThatIsWrittenToBecomesOneOfToday)
{
  {
    MapFile file = golden();
    EXPECT_FALSE(file.map().edges().begin()->second.length);
    file.append({.changes = {NodeAdded{{{3}, {}}}, EdgeAdded{{{2}, {3}, {0}, 0.1, 0.2, 1.9}}}});
  }
  const MapFile again = MapFile::open(path(), MapFile::Access::Read);
  EXPECT_EQ(again.map().edges().size(), 3U);
  EXPECT_EQ(again.map().edges().at({2}).length, 1.9);
  EXPECT_FALSE(again.map().edges().at({0}).length);
}

TEST_F(ExportTest, AVersion1FileIsReadWithoutBeingTouched)
{
  golden().close();
  sqlite3 *database = nullptr;
  ASSERT_EQ(sqlite3_open(path().c_str(), &database), SQLITE_OK);
  EXPECT_EQ(sqlite3_exec(database, "ALTER TABLE edge DROP COLUMN length_m; PRAGMA user_version = 1",
                         nullptr, nullptr, nullptr),
            SQLITE_OK);
  EXPECT_EQ(sqlite3_close(database), SQLITE_OK);
  const std::string before = contentsOf(path());
  EXPECT_EQ(MapFile::open(path(), MapFile::Access::Read).map().edges().size(), 2U);
  EXPECT_EQ(contentsOf(path()), before);
}

TEST_F(ExportTest, CanonicalTextIsTheGoldenOne)
{
  const std::string text = contentsOf(goldenDir() / "store" / "map_v1.canonical");
  const std::string withoutOrigin = text.substr(text.find('\n') + 1);
  EXPECT_EQ(exportCanonical(golden()), withoutOrigin);
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
