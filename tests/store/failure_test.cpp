// SPDX-License-Identifier: GPL-3.0-or-later
#include "store_fixture.h"

#include <homeward/core/error.h>
#include <homeward/store/export.h>

#include <gmock/gmock.h>
#include <sqlite3.h>
#include <sys/wait.h>

#include <fstream>

namespace homeward
{
namespace
{

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/** The StoreError that an action must throw: one line with the file's name. */
template <class Action> std::string storeErrorOf(const Action &action)
{
  try {
    action();
  }
  catch (const StoreError &error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("test.hwm"), Not(HasSubstr("\n"))));
    return error.what();
  }
  ADD_FAILURE() << "no StoreError";
  return "";
}

class MapFailureTest : public StoreTest
{
protected:
  /** A second program's access to the file, with none of the module's care. */
  void meddle(const std::string &sql) const
  {
    sqlite3 *other = nullptr;
    ASSERT_EQ(sqlite3_open(path().c_str(), &other), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(other, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK)
        << sqlite3_errmsg(other);
    EXPECT_EQ(sqlite3_close(other), SQLITE_OK);
  }

  void writeMap() const
  {
    auto file = MapFile::create(path(), smallHeader());
    fill(file);
    file.close();
  }

  std::string openError() const
  {
    return storeErrorOf([&] { MapFile::open(path()); });
  }

  /** Starts a map in a process that ends after `action` as if killed: nothing is closed. */
  template <class Action> void killAfter(const Action &action) const
  {
    const pid_t child = fork();
    if (child == 0) {
      try {
        auto file = MapFile::create(path(), smallHeader());
        action(file);
        _exit(0);
      }
      catch (const std::exception &) {
        _exit(1);
      }
    }
    int status = -1;
    waitpid(child, &status, 0);
    ASSERT_EQ(status, 0);
  }

  void overwrite(std::streamoff offset, const std::string &bytes) const
  {
    std::fstream file(path(), std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(offset);
    file << bytes;
  }
};

TEST_F(MapFailureTest, MissingFile)
{
  EXPECT_THAT(openError(), HasSubstr("does not exist"));
  EXPECT_THAT(files(), IsEmpty());
}

TEST_F(MapFailureTest, MissingFolder)
{
  const auto nowhere = folder() / "nowhere" / "test.hwm";
  EXPECT_THAT(storeErrorOf([&] { MapFile::create(nowhere, smallHeader()); }),
              HasSubstr("there is no folder"));
}

TEST_F(MapFailureTest, AFolderIsNoMap)
{
  std::filesystem::create_directory(path());
  EXPECT_THAT(openError(), HasSubstr("is a folder"));
  EXPECT_THAT(
      storeErrorOf([&] { MapFile::create(path(), smallHeader(), MapFile::IfExists::Replace); }),
      HasSubstr("is a folder"));
}

TEST_F(MapFailureTest, OtherFilesAreNoMapsAndStayAsTheyAre)
{
  const std::string words(5000, 'x');
  std::ofstream(path()) << words;
  EXPECT_THAT(openError(), HasSubstr("is not a Homeward map"));
  std::ifstream file(path());
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), words);

  std::ofstream(path(), std::ios::trunc);
  EXPECT_THAT(openError(), HasSubstr("is not a Homeward map"));
  EXPECT_EQ(std::filesystem::file_size(path()), 0U);

  meddle("CREATE TABLE node(id)");
  EXPECT_THAT(openError(), HasSubstr("is not a Homeward map"));
}

TEST_F(MapFailureTest, NewerVersion)
{
  writeMap();
  meddle("PRAGMA user_version = 4");
  EXPECT_THAT(openError(), HasSubstr("has version 4, this program reads up to 3"));
}

TEST_F(MapFailureTest, DamagedPages)
{
  writeMap();
  const auto size = static_cast<std::streamoff>(std::filesystem::file_size(path()));
  for (std::streamoff page = 4096; page + 4096 <= size; page += 4096) {
    overwrite(page, std::string(512, '\x5a'));
  }
  EXPECT_THAT(openError(), HasSubstr("is damaged"));
}

TEST_F(MapFailureTest, CutShort)
{
  writeMap();
  std::filesystem::resize_file(path(), std::filesystem::file_size(path()) / 2);
  EXPECT_THAT(openError(), HasSubstr("is damaged"));
}

TEST_F(MapFailureTest, DamagedContents)
{
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"DELETE FROM meta WHERE key = 'camera_hash'", "its header has no camera_hash"},
      {"UPDATE meta SET value = 'wide' WHERE key = 'panorama_width'", "panorama_width: wide"},
      {"UPDATE meta SET value = '0' WHERE key = 'panorama_width'", "panorama_width: 0"},
      {"UPDATE edge SET b = a", "to itself"},
      {"UPDATE edge SET id = id + 4", "edge 4 is out of order; the next id is 2"},
      {"UPDATE edge SET b = 77", "names a place that is not there"},
      {"DELETE FROM view; DELETE FROM direction WHERE id = 0", "the next id is 0"},
      {"DROP TABLE view", "no such table"}};
  for (const auto &[sql, expected] : cases) {
    std::filesystem::remove(path());
    writeMap();
    meddle(sql);
    EXPECT_THAT(storeErrorOf([&] {
                  const auto file = MapFile::open(path());
                  file.hasView({0});
                }),
                AllOf(HasSubstr("is damaged"), HasSubstr(expected)));
  }
}

TEST_F(MapFailureTest, DamagedView)
{
  writeMap();
  meddle("UPDATE view SET jpeg = x'00' WHERE node = 1");
  const auto file = MapFile::open(path());
  EXPECT_NO_THROW(file.panorama({0}));
  EXPECT_THAT(storeErrorOf([&] { file.panorama({1}); }), HasSubstr("view of node 1 changed"));
}

TEST_F(MapFailureTest, ASecondWriterIsNoticed)
{
  auto first = MapFile::create(path(), smallHeader());
  first.append(nodeUpdate(0));
  auto second = MapFile::open(path());
  second.append(nodeUpdate(1));
  EXPECT_THAT(storeErrorOf([&] { first.append(nodeUpdate(1)); }),
              HasSubstr("changed by another program"));
  EXPECT_EQ(first.map().nodes().size(), 1U);
  second.append(nodeUpdate(2));
  EXPECT_EQ(MapFile::open(path(), MapFile::Access::Read).map().nodes().size(), 3U);
}

TEST_F(MapFailureTest, TwoProgramsCannotStartTheSameMap)
{
  auto first = MapFile::create(path(), smallHeader());
  EXPECT_THAT(storeErrorOf([&] { MapFile::create(path(), smallHeader()); }),
              HasSubstr("is being written by another program"));
  first.append(nodeUpdate(0));
  EXPECT_EQ(MapFile::open(path()).map().nodes().size(), 1U);
}

TEST_F(MapFailureTest, ANameTakenMeanwhileIsNotOverwritten)
{
  auto file = MapFile::create(path(), smallHeader());
  std::ofstream(path()) << "somebody's";
  EXPECT_THAT(storeErrorOf([&] { file.append(nodeUpdate(0)); }), HasSubstr("exists already"));
  EXPECT_THAT(files(), ElementsAre("test.hwm"));
  EXPECT_EQ(std::filesystem::file_size(path()), 10U);
}

TEST_F(MapFailureTest, WhatAKilledRunLeftIsClearedAway)
{
  std::ofstream(folder() / "test.hwm.part") << std::string(9000, 'x');
  EXPECT_NO_THROW(MapFile::create(path(), smallHeader()));
  EXPECT_THAT(files(), IsEmpty());

  killAfter([&](MapFile &) {});
  ASSERT_THAT(files(), AllOf(Contains("test.hwm.part"), Not(Contains("test.hwm"))));
  auto file = MapFile::create(path(), smallHeader());
  file.append(nodeUpdate(0));
  file.close();
  EXPECT_THAT(files(), ElementsAre("test.hwm"));
}

TEST_F(MapFailureTest, AfterAKillTheLastAppendIsThere)
{
  killAfter([&](MapFile &file) { fill(file); });
  ASSERT_THAT(files(), ElementsAre("test.hwm", "test.hwm-shm", "test.hwm-wal"));

  const auto file = MapFile::open(path());
  EXPECT_EQ(file.map().nodes().size(), 3U);
  EXPECT_EQ(file.map().edges().size(), 2U);
  EXPECT_EQ(file.value("at_node"), "2");
}

TEST_F(MapFailureTest, ReplacingAMapThatWasKilledDoesNotInheritItsLog)
{
  killAfter([&](MapFile &file) { fill(file); });
  auto file = MapFile::create(path(), smallHeader(), MapFile::IfExists::Replace);
  file.append(nodeUpdate(0));
  file.close();
  EXPECT_EQ(MapFile::open(path()).map().nodes().size(), 1U);
}

/** Every connection opened while it lives may hold 24 pages and no more, as on a full disk. */
class SmallDisk
{
public:
  SmallDisk() { sqlite3_auto_extension(reinterpret_cast<void (*)()>(limit)); }
  ~SmallDisk() { sqlite3_reset_auto_extension(); }
  SmallDisk(const SmallDisk &) = delete;
  SmallDisk &operator=(const SmallDisk &) = delete;

private:
  static int limit(sqlite3 *database, char **, const void *)
  {
    return sqlite3_exec(database, "PRAGMA max_page_count = 24", nullptr, nullptr, nullptr);
  }
};

MapUpdate longUpdate(std::int64_t id)
{
  MapUpdate update = nodeUpdate(id);
  update.log.push_back({0.0, std::string(20000, 'x')});
  return update;
}

TEST_F(MapFailureTest, OnAFullDiskTheMapStaysAsItWas)
{
  const SmallDisk disk;
  auto file = MapFile::create(path(), smallHeader());
  std::string before;
  std::string error;
  std::int64_t id = 0;
  for (; id < 10 && error.empty(); ++id) {
    try {
      file.append(longUpdate(id));
      before = exportCanonical(file);
    }
    catch (const StoreError &full) {
      error = full.what();
    }
  }
  EXPECT_THAT(error, AllOf(HasSubstr("test.hwm"), HasSubstr("the disk is full")));
  ASSERT_GT(id, 1);
  EXPECT_EQ(exportCanonical(file), before);
  EXPECT_EQ(exportCanonical(MapFile::open(path(), MapFile::Access::Read)), before);
  file.append({.log = {{0.0, "short enough"}}});
  file.close();
  EXPECT_EQ(exportCanonical(MapFile::open(path())), before);
}

TEST_F(MapFailureTest, OnAFullDiskNoHalfMapGetsTheName)
{
  const SmallDisk disk;
  {
    auto file = MapFile::create(path(), smallHeader());
    MapUpdate update = nodeUpdate(0);
    update.log.push_back({0.0, std::string(200000, 'x')});
    EXPECT_THAT(storeErrorOf([&] { file.append(update); }), HasSubstr("the disk is full"));
    EXPECT_THAT(file.map().nodes(), IsEmpty());
  }
  EXPECT_THAT(files(), IsEmpty());
}

} // namespace
} // namespace homeward
