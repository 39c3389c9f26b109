// SPDX-License-Identifier: GPL-3.0-or-later
#include "store_fixture.h"

#include <homeward/store/map_check.h>

#include <gmock/gmock.h>
#include <sqlite3.h>

#include <fstream>

namespace homeward
{
namespace
{

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class MapCheckTest : public StoreTest
{
protected:
  void writeMap() const
  {
    std::filesystem::remove(path());
    auto file = MapFile::create(path(), smallHeader());
    fill(file);
    file.close();
  }

  /** The findings on a map that SQL has spoilt, one line each. */
  std::vector<std::string> afterSql(const std::string &sql) const
  {
    writeMap();
    sqlite3 *other = nullptr;
    EXPECT_EQ(sqlite3_open(path().c_str(), &other), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(other, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK)
        << sqlite3_errmsg(other);
    EXPECT_EQ(sqlite3_close(other), SQLITE_OK);
    return findings();
  }

  std::vector<std::string> findings() const
  {
    const MapCheck check = checkMap(path());
    EXPECT_THAT(check.findings, Each(AllOf(HasSubstr("test.hwm"), Not(HasSubstr("\n")))));
    return check.findings;
  }
};

TEST_F(MapCheckTest, CountsWhatASoundMapHolds)
{
  writeMap();
  const MapCheck check = checkMap(path());
  EXPECT_THAT(check.findings, IsEmpty());
  EXPECT_EQ(check.nodes, 3U);
  EXPECT_EQ(check.edges, 2U);
  EXPECT_EQ(check.pictures, 3U);
  EXPECT_THAT(files(), ElementsAre("test.hwm"));
}

TEST_F(MapCheckTest, FindsWhatIsWrongWithEachRow)
{
  EXPECT_THAT(afterSql("UPDATE edge SET b = 77 WHERE id = 1"),
              ElementsAre(HasSubstr("table edge, row 1, names a place that is not there"),
                          HasSubstr("node 77 is unknown")));
  EXPECT_THAT(afterSql("UPDATE edge SET b = a"), ElementsAre(HasSubstr("to itself")));
  EXPECT_THAT(afterSql("UPDATE edge SET successes = 3"),
              ElementsAre(HasSubstr("3 successes in 0 tries")));
  EXPECT_THAT(afterSql("UPDATE node SET name = 'lab'"),
              ElementsAre(HasSubstr("the name \"lab\" for node 1 is that of node 0")));
  EXPECT_THAT(afterSql("DELETE FROM next_id WHERE kind = 'edge'"),
              ElementsAre(HasSubstr("does not know the next id of a edge")));
  EXPECT_THAT(afterSql("UPDATE next_id SET id = 1 << 50"), ElementsAre(HasSubstr("ids beyond")));
  EXPECT_THAT(afterSql("DELETE FROM meta WHERE key = 'panorama_width'"),
              ElementsAre(HasSubstr("its header has no panorama_width")));
}

TEST_F(MapCheckTest, FindsEveryPictureThatIsNotSound)
{
  EXPECT_THAT(afterSql("DELETE FROM view WHERE node = 0;"
                       "UPDATE view SET jpeg = zeroblob(9) WHERE node = 1"),
              ElementsAre(HasSubstr("node 0 has no picture"),
                          HasSubstr("node 1 has a picture that changed since it was stored")));
  EXPECT_THAT(afterSql("UPDATE meta SET value = 33 WHERE key = 'panorama_width'"),
              ElementsAre(HasSubstr("node 0 has no panorama"), HasSubstr("node 1 has no panorama"),
                          HasSubstr("node 2 has no panorama")));
}

TEST_F(MapCheckTest, FindsABitThatFlippedInAPicture)
{
  writeMap();
  const ViewBytes picture = MapFile::open(path(), MapFile::Access::Read).view({1});
  std::fstream file(path(), std::ios::in | std::ios::out | std::ios::binary);
  const std::string all(std::istreambuf_iterator<char>(file), {});
  // The end of the blob in the file; that of a small picture is on one page.
  const std::string tail(picture.end() - 40, picture.end());
  const auto place = all.find(tail);
  ASSERT_NE(place, std::string::npos);
  file.seekp(static_cast<std::streamoff>(place) + 11);
  file.put(static_cast<char>(tail[11] ^ 0x10));
  file.close();
  EXPECT_THAT(findings(), ElementsAre(HasSubstr("node 1 has a picture that changed")));
}

TEST_F(MapCheckTest, FindsThatAFileIsCutOrNone)
{
  EXPECT_THAT(findings(), ElementsAre(HasSubstr("there is no such file")));
  writeMap();
  std::filesystem::resize_file(path(), std::filesystem::file_size(path()) / 2);
  EXPECT_THAT(findings(), Not(IsEmpty()));
  std::filesystem::resize_file(path(), 0);
  EXPECT_THAT(findings(), ElementsAre(HasSubstr("is not a Homeward map")));
}

} // namespace
} // namespace homeward
