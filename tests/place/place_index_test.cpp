// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/error.h>
#include <homeward/core/random.h>
#include <homeward/place/place_index.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace homeward
{
namespace
{

Signature signature(std::initializer_list<float> counts)
{
  return {SignatureKind::AbsoluteDifferences, 10, counts};
}

TEST(PlaceIndex, givesTheNearestFirst)
{
  PlaceIndex index(SignatureKind::AbsoluteDifferences);
  index.add(NodeId{0}, signature({10, 0}));
  index.add(NodeId{1}, signature({4, 6}));
  index.add(NodeId{2}, signature({0, 10}));
  const std::vector<Match> best = index.nearest(signature({5, 5}), 2);
  ASSERT_EQ(best.size(), 2U);
  EXPECT_EQ(best[0].node, NodeId{1});
  EXPECT_DOUBLE_EQ(best[0].dissimilarity, 0.2);
  EXPECT_EQ(best[1].node, NodeId{0}) << "of equals, the smaller id";
  EXPECT_EQ(index.nearest(signature({5, 5}), 9).size(), 3U);
}

TEST(PlaceIndex, withinIsStrict)
{
  PlaceIndex index(SignatureKind::AbsoluteDifferences);
  index.add(NodeId{0}, signature({10, 0}));
  index.add(NodeId{1}, signature({4, 6}));
  EXPECT_EQ(index.within(signature({5, 5}), 1.0).size(), 1U);
  EXPECT_EQ(index.within(signature({5, 5}), 1.01).size(), 2U);
  EXPECT_TRUE(index.within(signature({5, 5}), 0.1).empty());
}

TEST(PlaceIndex, agreesWithComparingOneByOne)
{
  Random random(1, 0);
  PlaceIndex index(SignatureKind::Jeffrey);
  std::vector<std::pair<double, std::int64_t>> expected;
  const auto draw = [&] {
    Signature drawn{SignatureKind::Jeffrey, 1000, std::vector<float>(256)};
    for (float &count : drawn.values) {
      count = static_cast<float>(std::floor(random.uniform(0.0, 8.0)));
    }
    return drawn;
  };
  const Signature query = draw();
  for (std::int64_t id = 0; id < 50; ++id) {
    const Signature stored = draw();
    expected.emplace_back(dissimilarity(query, stored), id);
    index.add(NodeId{id}, stored);
  }
  std::sort(expected.begin(), expected.end());
  const std::vector<Match> found = index.nearest(query, 50);
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].node.value, expected[i].second);
  }
}

TEST(PlaceIndex, forgetsWhatIsRemoved)
{
  PlaceIndex index(SignatureKind::AbsoluteDifferences);
  index.add(NodeId{0}, signature({10, 0}));
  index.add(NodeId{1}, signature({4, 6}));
  index.remove(NodeId{0});
  EXPECT_FALSE(index.contains(NodeId{0}));
  ASSERT_EQ(index.nearest(signature({10, 0}), 5).size(), 1U);
  EXPECT_EQ(index.nearest(signature({10, 0}), 5)[0].node, NodeId{1});
  EXPECT_THROW(index.remove(NodeId{0}), LogicError);
}

TEST(PlaceIndex, refusesWhatItCannotCompare)
{
  PlaceIndex index(SignatureKind::AbsoluteDifferences);
  EXPECT_TRUE(index.nearest(signature({1, 2}), 3).empty());
  index.add(NodeId{0}, signature({10, 0}));
  EXPECT_THROW(index.add(NodeId{0}, signature({10, 0})), LogicError);
  EXPECT_THROW(index.add(NodeId{1}, signature({10, 0, 0})), LogicError);
  EXPECT_THROW(index.add(NodeId{1}, {SignatureKind::Jeffrey, 10, {10, 0}}), LogicError);
  EXPECT_THROW(index.nearest(signature({1, 2, 3}), 3), LogicError);
}

} // namespace
} // namespace homeward
