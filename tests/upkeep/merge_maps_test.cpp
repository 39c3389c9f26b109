// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/error.h>
#include <homeward/store/export.h>
#include <homeward/store/map_check.h>
#include <homeward/upkeep/merge_maps.h>

#include "folder.h"
#include "room_map.h"

#include <gmock/gmock.h>

namespace homeward
{
namespace
{

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// Two drives through one room; places 1 and 2 of the first are 2 and 0 of the second, in other
// headings:
//
//     a:  0 -- 1 -- 2 -- 3
//     b:       2    0 -- 1 (beside 3)     0 -- 1 -- 2
const std::vector<Pose2> kFirst = {
    {-3.5, -2.0, 0.0}, {-1.5, 0.0, 0.5}, {1.5, 0.5, -1.0}, {3.5, -2.0, 2.0}};
const std::vector<Pose2> kSecond = {{1.45, 0.55, 1.0}, {3.4, 2.2, 0.3}, {-1.45, 0.05, -2.0}};

class MergeTest : public ::testing::Test
{
protected:
  std::filesystem::path path(const std::string &name) const { return m_folder / name; }

  MapFile write(const std::string &name, const std::vector<Pose2> &places, std::uint64_t room = 3,
                const std::string &camera = "camera") const
  {
    writeRoomMap(path(name), SyntheticRoom(room, 10.0, 7.0), places, camera);
    return MapFile::open(path(name), MapFile::Access::Read);
  }

private:
  Folder m_folder;
};

TEST_F(MergeTest, PlacesOfTwoMapsAreRecognisedWithTheirTurn)
{
  const MapFile a = write("a.hwm", kFirst);
  const MapFile b = write("b.hwm", kSecond);
  const auto pairs = agreeingPairs(a.map(), b.map(), alikePlaces(a, b));
  ASSERT_THAT(pairs, SizeIs(2));
  for (const PlacePair &pair : pairs) {
    const bool first = pair.b == NodeId{0};
    EXPECT_EQ(pair.a, NodeId{first ? 2 : 1});
    EXPECT_NEAR(wrapAngle(pair.turn - (first ? 2.0 : -2.5)), 0.0, 0.1);
    EXPECT_GE(pair.probability, 0.9);
  }
}

TEST_F(MergeTest, OneMapIsMadeOfTwo)
{
  const MapFile a = write("a.hwm", kFirst);
  {
    write("b.hwm", kSecond);
    MapFile named = MapFile::open(path("b.hwm"));
    named.append({.changes = {NodeNamed{{1}, "window"}, EdgeTried{{0}, "lost", 9.0, 1.0}}});
  }
  const MapFile b = MapFile::open(path("b.hwm"), MapFile::Access::Read);
  const std::string textA = exportCanonical(a);
  const std::string textB = exportCanonical(b);
  const std::vector<PlacePair> pairs = {{{2}, {0}, 0.95, 2.0}, {{1}, {2}, 0.95, -2.5}};
  const auto became = mergeMaps(a, b, pairs, path("c.hwm"));
  EXPECT_EQ(became, (std::map<NodeId, NodeId>{{{0}, {2}}, {{1}, {5}}, {{2}, {1}}}));

  const MapFile c = MapFile::open(path("c.hwm"), MapFile::Access::Read);
  EXPECT_THAT(checkMap(path("c.hwm")).findings, IsEmpty());
  EXPECT_EQ(c.map().nodes().size(), 5U);
  EXPECT_EQ(c.view({5}), b.view({1}));
  EXPECT_EQ(c.view({2}), a.view({2}));
  EXPECT_EQ(c.map().find("window"), NodeId{5});
  EXPECT_EQ(c.map().edgeBetween({2}, {5})->statistics.lastError, "lost");
  EXPECT_THAT(c.map().neighbours({5}), ElementsAre(NodeId{1}, NodeId{2}));
  // From where a stood at node 2 the window lies where it truly does, to the turn's rounding.
  const Pose2 window = kSecond[1];
  EXPECT_NEAR(wrapAngle(*c.map().departureBearing({2}, {5}) - trueDirection(kFirst[2], window)),
              0.0, 0.05);
  EXPECT_EQ(exportCanonical(a), textA);
  EXPECT_EQ(exportCanonical(b), textB);
}

TEST_F(MergeTest, NamesThatAreTakenStayWithTheFirstMap)
{
  for (const std::string name : {"a.hwm", "b.hwm"}) {
    write(name, kSecond);
    MapFile::open(path(name)).append({.changes = {NodeNamed{{1}, "window"}}});
  }
  const MapFile a = MapFile::open(path("a.hwm"), MapFile::Access::Read);
  mergeMaps(a, MapFile::open(path("b.hwm"), MapFile::Access::Read), {{{0}, {0}, 1.0, 0.0}},
            path("c.hwm"));
  EXPECT_EQ(MapFile::open(path("c.hwm")).map().find("window"), NodeId{1});
}

TEST_F(MergeTest, RefusesMapsOfDifferentCamerasAndNamesThatExist)
{
  const MapFile a = write("a.hwm", kFirst);
  const MapFile other = write("b.hwm", kSecond, 3, "another");
  EXPECT_THROW(alikePlaces(a, other), StoreError);
  EXPECT_THROW(mergeMaps(a, other, {}, path("c.hwm")), StoreError);
  EXPECT_THROW(mergeMaps(a, a, {}, path("b.hwm")), StoreError);
  EXPECT_FALSE(std::filesystem::exists(path("c.hwm")));
}

TEST_F(MergeTest, NothingIsLeftOfAMergeThatFails)
{
  const MapFile a = write("a.hwm", kFirst);
  EXPECT_THROW(mergeMaps(a, a, {{{9}, {0}, 1.0, 0.0}}, path("c.hwm")), LogicError);
  std::vector<std::string> left;
  for (const auto &entry : std::filesystem::directory_iterator(path("."))) {
    left.push_back(entry.path().filename().string());
  }
  EXPECT_THAT(left, ElementsAre("a.hwm"));
}

TEST_F(MergeTest, AnotherRoomHasNoPlaceInCommon)
{
  const MapFile a = write("a.hwm", kFirst);
  const MapFile b = write("b.hwm", kSecond, 8);
  EXPECT_THAT(agreeingPairs(a.map(), b.map(), alikePlaces(a, b)), IsEmpty());
}

TEST_F(MergeTest, OnePlaceSeenTwiceLooksTheSameAnotherDoesNot)
{
  const SyntheticRoom room(3, 10.0, 7.0);
  const Panorama a = room.view({-1.5, 0.0, 0.5});
  const PlaceLook same = comparePlaces(a, room.view({-1.4, 0.05, -2.0}));
  EXPECT_GE(same.probability, 0.9);
  ASSERT_TRUE(same.turn);
  EXPECT_NEAR(*same.turn, -2.5, 0.1);
  EXPECT_LT(comparePlaces(a, room.view({3.5, 2.0, 0.5})).probability, 0.5);
}

/** Nodes at `places` in a row. */
TopologicalMap rowOf(const std::vector<Pose2> &places)
{
  TopologicalMap map;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const NodeId id = map.nextNodeId();
    map.apply(NodeAdded{{id}});
    if (i > 0) {
      map.apply(EdgeAdded{{map.nextEdgeId(),
                           {id.value - 1},
                           id,
                           trueDirection(places[i - 1], places[i]),
                           trueDirection(places[i], places[i - 1]),
                           (places[i].translation() - places[i - 1].translation()).norm()}});
    }
  }
  return map;
}

const std::vector<Pose2> kCorridor = {
    {0.0, 0.0, 0.0}, {4.0, 0.0, 1.0}, {8.0, 0.0, -1.0}, {12.0, 0.0, 2.0}, {16.0, 3.0, 0.0}};

TEST(AgreeingPairs, LeaveOutWhatLiesElsewhereOrStandsOtherwise)
{
  const TopologicalMap map = rowOf(kCorridor);
  const PlacePair right0{{0}, {0}, 0.93, 0.0};
  const PlacePair right1{{1}, {1}, 0.91, 0.0};
  const PlacePair right4{{4}, {4}, 0.92, 0.0};
  const PlacePair nextDoor{{3}, {2}, 0.99, 3.0};
  const PlacePair turned{{2}, {2}, 0.98, 2.0};
  const auto sets = agreeingPairs(map, map, {nextDoor, right1, right0, turned, right4});
  EXPECT_THAT(sets, ElementsAre(right0, right4, right1));
}

TEST(AgreeingPairs, KeepEachPlaceOnce)
{
  const TopologicalMap map = rowOf({{0.0, 0.0, 0.0}, {0.6, 0.0, 0.0}, {8.0, 0.0, 0.0}});
  const PlacePair best{{0}, {0}, 0.97, 0.0};
  const PlacePair third{{2}, {2}, 0.95, 0.0};
  EXPECT_THAT(agreeingPairs(map, map, {best, {{0}, {1}, 0.96, 0.0}, third}),
              ElementsAre(best, third));
  EXPECT_THAT(agreeingPairs(map, map, {best, {{1}, {0}, 0.96, 0.0}, third}),
              ElementsAre(best, third));
}

TEST(AgreeingPairs, OneAloneMustBeSurer)
{
  const TopologicalMap map = rowOf(kCorridor);
  EXPECT_THAT(agreeingPairs(map, map, {{{0}, {0}, 0.98, 0.0}}), IsEmpty());
  EXPECT_THAT(agreeingPairs(map, map, {{{0}, {0}, 0.991, 0.0}}), SizeIs(1));
  EXPECT_THAT(agreeingPairs(map, map, {}), IsEmpty());
}

TEST(AgreeingPairs, HoldInWhateverHeadingsTheMapsWereMade)
{
  std::vector<Pose2> other = kCorridor;
  const std::vector<double> turns = {0.4, -2.0, 3.0, 1.0, -0.5};
  std::vector<PlacePair> pairs;
  for (std::size_t i = 0; i < other.size(); ++i) {
    other[i].heading += turns[i];
    const auto id = static_cast<std::int64_t>(i);
    pairs.push_back({{id}, {id}, 0.95, turns[i]});
  }
  EXPECT_THAT(agreeingPairs(rowOf(kCorridor), rowOf(other), pairs), SizeIs(5));
}

} // namespace
} // namespace homeward
