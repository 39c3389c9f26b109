// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/id.h>

#include <gtest/gtest.h>
#include <type_traits>
#include <unordered_set>

namespace homeward
{
namespace
{

TEST(Id, KindsDoNotMix)
{
  static_assert(!std::is_same_v<NodeId, EdgeId>);
  static_assert(!std::is_convertible_v<NodeId, EdgeId>);
  static_assert(!std::is_convertible_v<NodeId, std::int64_t>);
  static_assert(!std::is_convertible_v<std::int64_t, NodeId>);
}

TEST(Id, OrderAndEqualityAreThoseOfTheNumber)
{
  EXPECT_EQ(NodeId{3}, NodeId{3});
  EXPECT_LT(NodeId{2}, NodeId{3});
  EXPECT_LT(NodeId{}, NodeId{0}); // an id that names nothing comes before all
}

TEST(Id, HashesAsAKey)
{
  const std::unordered_set<NodeId> ids{{1}, {2}, {1}};
  EXPECT_EQ(ids.size(), 2U);
  EXPECT_TRUE(ids.contains(NodeId{2}));
}

} // namespace
} // namespace homeward
