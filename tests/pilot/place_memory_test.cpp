// SPDX-License-Identifier: GPL-3.0-or-later
#include "synthetic_room.h"

#include <homeward/core/error.h>
#include <homeward/pilot/place_memory.h>

#include <gtest/gtest.h>

namespace homeward
{
namespace
{

const SyntheticRoom kRoom(41, 6.0, 5.0);

Panorama viewFrom(double x, double heading = 0.0)
{
  return kRoom.view({x, 0.2, heading});
}

/** Knows places 1.2 m apart. */
PlaceMemory memory(Recognition recognition)
{
  PlaceMemory places({recognition, 500.0, 40});
  for (int i = 0; i < 3; ++i) {
    places.add(NodeId{i}, viewFrom(-1.2 + 1.2 * i));
  }
  return places;
}

TEST(PlaceMemory, findsThePlaceSeenFromBesideItInAnyHeading)
{
  const PlaceMemory places = memory(Recognition::Verified);
  const auto matches = places.recognise(viewFrom(0.15, 2.0));
  ASSERT_EQ(matches.size(), 3U);
  EXPECT_EQ(matches[0].node, NodeId{1});
  EXPECT_TRUE(matches[0].verified);
  EXPECT_GE(matches[0].probability, matches[1].probability);
  EXPECT_GT(matches[0].dissimilarity, 0.0);
}

TEST(PlaceMemory, tellsWhetherItStandsThere)
{
  const PlaceMemory places = memory(Recognition::Verified);
  EXPECT_GT(places.standingAt(NodeId{1}, viewFrom(0.02, 2.0)), 0.9);
  EXPECT_LT(places.standingAt(NodeId{2}, viewFrom(0.02, 2.0)), 0.1);
  EXPECT_THROW(places.standingAt(NodeId{7}, viewFrom(0.0)), LogicError);
}

TEST(PlaceMemory, byHistogramTheNearestBelowTheThresholdCounts)
{
  const PlaceMemory places = memory(Recognition::Histogram);
  const auto matches = places.recognise(viewFrom(0.02, 2.0));
  ASSERT_EQ(matches.size(), 3U);
  EXPECT_EQ(matches[0].node, NodeId{1});
  EXPECT_TRUE(matches[0].verified);
  EXPECT_LT(matches[0].dissimilarity, 500.0);
  EXPECT_FALSE(matches[1].verified);
  EXPECT_EQ(places.standingAt(NodeId{2}, viewFrom(0.0)), 1.0) << "nothing is verified";
  PlaceMemory strict({Recognition::Histogram, 1e-3, 40});
  strict.add(NodeId{0}, viewFrom(0.0));
  EXPECT_FALSE(strict.recognise(viewFrom(0.5))[0].verified);
}

TEST(PlaceMemory, aPlaceIsKnownOnce)
{
  PlaceMemory places({});
  places.add(NodeId{0}, viewFrom(0.0));
  EXPECT_THROW(places.add(NodeId{0}, viewFrom(0.0)), LogicError);
  EXPECT_THROW(places.snapshot(NodeId{1}), LogicError);
  EXPECT_THROW(places.replace(NodeId{1}, viewFrom(0.0)), LogicError);
}

TEST(PlaceMemory, aPlaceIsKnownByItsNewestPictureAlone)
{
  PlaceMemory places({});
  places.add(NodeId{0}, viewFrom(0.0));
  places.add(NodeId{1}, viewFrom(1.5));
  const Panorama newer = viewFrom(-1.5);
  EXPECT_GT(places.seeAnew(NodeId{0}, newer).change, 0.1);
  places.replace(NodeId{0}, newer);
  EXPECT_EQ(places.snapshot(NodeId{0}).image.data, newer.image.data);
  const SeenAnew seen = places.seeAnew(NodeId{0}, newer);
  EXPECT_TRUE(seen.likeliest);
  EXPECT_GT(seen.sure, 0.99);
  EXPECT_LT(seen.change, 0.01);
  EXPECT_FALSE(places.seeAnew(NodeId{1}, newer).likeliest);
  EXPECT_EQ(places.recognise(newer).size(), 2U);
}

} // namespace
} // namespace homeward
