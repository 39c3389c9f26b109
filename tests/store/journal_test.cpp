// SPDX-License-Identifier: GPL-3.0-or-later
#include "store_fixture.h"

#include <homeward/core/error.h>
#include <homeward/store/export.h>
#include <homeward/store/node_views.h>

#include <gmock/gmock.h>

namespace homeward
{
namespace
{

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class JournalTest : public StoreTest
{
protected:
  /** Nodes 0 to 3 in a row, 3 joined to 0 too. */
  MapFile square() const
  {
    auto file = MapFile::create(path(), smallHeader());
    fill(file);
    file.append(nodeUpdate(3));
    file.append({.changes = {EdgeAdded{{{2}, {2}, {3}, 0.25, -0.75, 1.9}},
                             EdgeAdded{{{3}, {3}, {0}, 1.25, 2.75, 1.8}}}});
    return file;
  }

  /** The edit changes the map, survives reopening, and undo brings back all, pictures included. */
  void expectUndone(const std::vector<MapChange> &changes) const
  {
    std::filesystem::remove(path());
    auto file = square();
    const std::string before = exportCanonical(file);
    const TopologicalMap map = file.map();
    EXPECT_EQ(file.edit("something", {.changes = changes}), 1);
    const std::string after = exportCanonical(file);
    EXPECT_NE(after, before);
    file.close();

    auto again = MapFile::open(path());
    EXPECT_EQ(exportCanonical(again), after);
    EXPECT_EQ(again.undo(), (JournalEntry{1, "something", true}));
    EXPECT_EQ(again.map(), map);
    EXPECT_EQ(exportCanonical(again), before);
    again.close();
    EXPECT_EQ(exportCanonical(MapFile::open(path())), before);
  }

  static std::string undoError(MapFile &file)
  {
    const TopologicalMap before = file.map();
    try {
      file.undo();
    }
    catch (const StoreError &error) {
      EXPECT_EQ(file.map(), before);
      return error.what();
    }
    return "undone";
  }
};

TEST_F(JournalTest, EveryKindOfEditIsUndone)
{
  expectUndone({NodeNamed{{1}, "hall"}});
  expectUndone({NodeRemoved{{1}}});
  expectUndone({EdgeRemoved{{2}}});
  expectUndone({EdgeForbidden{{2}}});
  expectUndone({EdgeTried{{2}, "lost", 3.0, 4.0}});
  expectUndone({NodesMerged{{0}, {2}, 0.5}});
  expectUndone({NodesMerged{{2}, {3}, -0.5}});
  expectUndone({DirectionSettled{{0}, {1}, DirectionState::Closed, "a cupboard"}});
}

TEST_F(JournalTest, UndoesOneAfterTheOther)
{
  auto file = square();
  const TopologicalMap start = file.map();
  file.edit("name 1 hall", {.changes = {NodeNamed{{1}, "hall"}}});
  const TopologicalMap named = file.map();
  file.edit("merge 1 and 3", {.changes = {NodesMerged{{1}, {3}, 0.0}}});
  file.edit("delete 2", {.changes = {NodeRemoved{{2}}}});
  file.undo();
  file.undo();
  EXPECT_EQ(file.map(), named);
  EXPECT_EQ(file.edit("name 2 lab", {.changes = {NodeNamed{{2}, "lab"}}}), 4);
  EXPECT_THAT(file.journal(),
              ElementsAre(JournalEntry{1, "name 1 hall", false},
                          JournalEntry{2, "merge 1 and 3", true}, JournalEntry{3, "delete 2", true},
                          JournalEntry{4, "name 2 lab", false}));
  EXPECT_EQ(file.undo().number, 4);
  EXPECT_EQ(file.undo().number, 1);
  EXPECT_EQ(file.map(), start);
  EXPECT_THAT(undoError(file), HasSubstr("has no edit to undo"));
}

TEST_F(JournalTest, IdsOfWhatIsGoneAreNotReusedAfterReopening)
{
  {
    auto file = square();
    file.edit("delete 3", {.changes = {NodeRemoved{{3}}}});
  }
  auto file = MapFile::open(path());
  EXPECT_EQ(file.map().nextNodeId(), NodeId{4});
  EXPECT_EQ(file.map().nextEdgeId(), EdgeId{4});
  file.append(nodeUpdate(4));
  file.undo();
  EXPECT_EQ(file.map().nodes().size(), 5U);
  EXPECT_EQ(file.map().nextNodeId(), NodeId{5});
}

TEST_F(JournalTest, WhatGrewElsewhereIsNoConflict)
{
  auto file = square();
  file.edit("delete 3", {.changes = {NodeRemoved{{3}}}});
  file.append({.changes = {EdgeTried{{0}, "", 5.0, 6.0}}});
  file.undo();
  EXPECT_EQ(file.map().edge({0}).statistics.tries, 1);
  EXPECT_TRUE(file.map().contains({3}));
}

TEST_F(JournalTest, RefusesToUndoWhatTheMapHasGrownOver)
{
  auto file = square();
  file.edit("merge 0 and 2", {.changes = {NodesMerged{{0}, {2}, 0.0}}});
  file.append({.changes = {NodeNamed{{0}, "hall"}}});
  file.edit("no-go 0 3", {.changes = {EdgeForbidden{{3}}}});
  file.append({.changes = {EdgeRemoved{{3}}}});
  EXPECT_THAT(undoError(file), HasSubstr("edit 2 (no-go 0 3) cannot be undone, the map has "
                                         "changed there since"));
  EXPECT_FALSE(file.journal().back().undone);
}

TEST_F(JournalTest, RefusesAnUndoThatWouldBreakARuleOfTheMap)
{
  auto file = square();
  file.append({.changes = {NodeNamed{{1}, "hall"}}});
  file.edit("delete 1", {.changes = {NodeRemoved{{1}}}});
  file.append({.changes = {NodeNamed{{2}, "hall"}}}); // free meanwhile
  EXPECT_THAT(undoError(file), HasSubstr("cannot be undone"));
  file.append({.changes = {NodeNamed{{2}, ""}}});
  EXPECT_EQ(file.undo().number, 1);

  file.edit("delete the way", {.changes = {EdgeRemoved{{2}}}});
  file.append({.changes = {EdgeAdded{{{4}, {3}, {2}}}}});
  EXPECT_THAT(undoError(file), HasSubstr("cannot be undone"));
}

TEST_F(JournalTest, AnUndoNeedsAMapToWriteTo)
{
  square().close();
  auto read = MapFile::open(path(), MapFile::Access::Read);
  EXPECT_THROW(read.undo(), LogicError);
  EXPECT_THROW(read.edit("name", {.changes = {NodeNamed{{0}, "hall"}}}), LogicError);
}

TEST_F(JournalTest, AnEditThatBreaksARuleIsNotInIt)
{
  auto file = square();
  EXPECT_THROW(file.edit("no", {.changes = {NodeRemoved{{1}}, NodeRemoved{{1}}}}), LogicError);
  EXPECT_THAT(file.journal(), IsEmpty());
  EXPECT_TRUE(file.map().contains({1}));
}

TEST_F(JournalTest, ARefreshedPictureReplacesTheOldOne)
{
  auto file = square();
  NodeViews views(file);
  const cv::Mat before = views({1}).image.clone();
  const ViewBytes newer = encodeView(smallPanorama(9));
  file.append({.refreshes = {{{1}, newer}}});
  EXPECT_EQ(file.view({1}), newer);
  EXPECT_NE(cv::norm(views({1}).image, before, cv::NORM_INF), 0.0);
  file.edit("refresh", {.refreshes = {{{1}, encodeView(smallPanorama(7))}}});
  file.undo();
  EXPECT_EQ(file.view({1}), newer);
  EXPECT_EQ(cv::norm(views({1}).image, file.panorama({1}).image, cv::NORM_INF), 0.0);
}

TEST_F(JournalTest, RefusesToRefreshWhatIsNotThere)
{
  auto file = square();
  file.append({.changes = {NodeAdded{{{4}, {}}}}});
  const std::string before = exportCanonical(file);
  const ViewBytes newer = encodeView(smallPanorama(9));
  EXPECT_THROW(file.append({.refreshes = {{{0}, newer}, {{4}, newer}}}), LogicError);
  EXPECT_THROW(file.append({.refreshes = {{{7}, newer}}}), LogicError);
  EXPECT_THROW(file.append({.refreshes = {{{1}, {1, 2, 3}}}}), RuntimeError);
  EXPECT_EQ(exportCanonical(file), before);
}

} // namespace
} // namespace homeward
