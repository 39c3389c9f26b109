// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/error.h>
#include <homeward/core/random.h>
#include <homeward/place/place_index.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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
  EXPECT_THROW(index.add(NodeId{1}, signature({10, -1})), LogicError);
  EXPECT_THROW(index.add(NodeId{1}, signature({10, std::nanf("")})), LogicError);
  EXPECT_THROW(index.nearest(signature({1, 2, 3}), 3), LogicError);
  EXPECT_THROW(PlaceIndex(SignatureKind::Jeffrey, {.threads = 0}), LogicError);
  PlaceIndex bytes(SignatureKind::EdgeBytes);
  EXPECT_THROW(bytes.add(NodeId{0}, {SignatureKind::EdgeBytes, 10, {256}}), LogicError);
  EXPECT_THROW(bytes.add(NodeId{0}, {SignatureKind::EdgeBytes, 10, {0.5F}}), LogicError);
  PlaceIndex spectra(SignatureKind::AlignedEdges);
  EXPECT_THROW(spectra.add(NodeId{0}, {SignatureKind::AlignedEdges, 10, {0.5F}}), LogicError);
}

TEST(PlaceIndex, anyOrderOfAddingAndRemovingIsTheSame)
{
  PlaceIndex index(SignatureKind::AbsoluteDifferences);
  for (std::int64_t id = 0; id < 10; ++id) {
    index.add(NodeId{id}, signature({static_cast<float>(id), 0}));
  }
  for (const std::int64_t id : {3, 9, 0, 4}) {
    index.remove(NodeId{id});
  }
  index.add(NodeId{3}, signature({20, 0}));
  std::vector<std::int64_t> order;
  for (const Match &match : index.nearest(signature({0, 0}), 20)) {
    order.push_back(match.node.value);
  }
  EXPECT_EQ(order, (std::vector<std::int64_t>{1, 2, 5, 6, 7, 8, 3}));
}

/** What holds for signatures of every kind, drawn at random in several sizes. */
class PlaceIndexLaw : public testing::TestWithParam<SignatureKind>
{
protected:
  static bool turns() { return traits(GetParam()).distance == SignatureDistance::TurnCorrelation; }

  /** Differences of numbers near one are good to this; the others are sums of small ones. */
  static double absoluteError() { return turns() ? 4e-6 : 1e-9; }

  /** Some zeros, some large; values of bytes fit all kinds. Spectra come in rows of 32. */
  Signature draw(std::size_t size)
  {
    size = turns() ? (size + 31) / 32 * 32 : size;
    Signature drawn{GetParam(), 1000, std::vector<float>(size)};
    for (float &value : drawn.values) {
      value = static_cast<float>(std::max(0.0, std::floor(m_random.uniform(-40.0, 256.0))));
    }
    return drawn;
  }

  /** A little unlike another. */
  Signature vary(Signature signature)
  {
    for (float &value : signature.values) {
      value = std::clamp(value + (m_random.uniform(0.0, 1.0) < 0.1 ? 1.0F : 0.0F), 0.0F, 255.0F);
    }
    return signature;
  }

  Random m_random{1, 0};
};

constexpr double kRelativeError = 1e-4;

TEST_P(PlaceIndexLaw, agreesWithComparingOneByOne)
{
  for (const std::size_t size : {1U, 7U, 16U, 256U, 601U}) {
    for (const bool vectorised : {true, false}) {
      PlaceIndex index(GetParam(), {.vectorised = vectorised});
      const Signature query = draw(size);
      std::vector<Signature> stored{query, vary(query), {GetParam(), 1000, query.values}};
      std::fill(stored[2].values.begin(), stored[2].values.end(), 0.0F);
      while (stored.size() < 50) {
        stored.push_back(draw(size));
      }
      for (std::size_t i = 0; i < stored.size(); ++i) {
        index.add(NodeId{static_cast<std::int64_t>(i)}, stored[i]);
      }
      double last = 0.0;
      for (const Match &match : index.nearest(query, stored.size())) {
        const double expected =
            dissimilarity(query, stored[static_cast<std::size_t>(match.node.value)]);
        EXPECT_NEAR(match.dissimilarity, expected, kRelativeError * expected + absoluteError())
            << size;
        EXPECT_GE(match.dissimilarity, last);
        last = match.dissimilarity;
      }
    }
  }
}

TEST_P(PlaceIndexLaw, zeroOnItself)
{
  PlaceIndex index(GetParam());
  const Signature here = draw(300);
  index.add(NodeId{0}, draw(300));
  index.add(NodeId{1}, here);
  const std::vector<Match> best = index.nearest(here, 1);
  EXPECT_EQ(best[0].node, NodeId{1});
  EXPECT_NEAR(best[0].dissimilarity, 0.0, absoluteError());
}

TEST_P(PlaceIndexLaw, threadsAndBatchesChangeNothing)
{
  PlaceIndex one(GetParam());
  PlaceIndex two(GetParam(), {.threads = 2});
  constexpr std::int64_t kNodes = 18001; // enough for threads with 256 bytes each
  two.reserve(kNodes);
  Signature drawn = draw(256);
  for (std::int64_t id = 0; id < kNodes; ++id) {
    drawn.values[static_cast<std::size_t>(id % 256)] = static_cast<float>(id % 97);
    one.add(NodeId{kNodes - id}, drawn);
    two.add(NodeId{kNodes - id}, drawn);
  }
  const std::vector<Signature> queries{draw(256), draw(256), drawn};
  const auto asPairs = [](const std::vector<Match> &matches) {
    std::vector<std::pair<std::int64_t, double>> pairs;
    pairs.reserve(matches.size());
    for (const Match &match : matches) {
      pairs.emplace_back(match.node.value, match.dissimilarity);
    }
    return pairs;
  };
  const auto batch = two.nearest(queries, 100);
  ASSERT_EQ(batch.size(), queries.size());
  for (std::size_t q = 0; q < queries.size(); ++q) {
    const auto expected = asPairs(one.nearest(queries[q], 100));
    EXPECT_EQ(asPairs(two.nearest(queries[q], 100)), expected);
    EXPECT_EQ(asPairs(batch[q]), expected);
    const double limit = expected[50].second;
    EXPECT_EQ(asPairs(two.within(queries[q], limit)), asPairs(one.within(queries[q], limit)));
  }
}

std::vector<SignatureKind> allKinds()
{
  std::vector<SignatureKind> kinds;
  for (const SignatureTraits &kind : signatureKinds()) {
    kinds.push_back(kind.kind);
  }
  return kinds;
}

INSTANTIATE_TEST_SUITE_P(Kinds, PlaceIndexLaw, testing::ValuesIn(allKinds()),
                         [](const auto &instance) { return std::string(name(instance.param)); });

TEST(PlaceIndex, jeffreyHoldsItsErrorFromLikeToDisjoint)
{
  // Two bins whose shares go from the same to all in one: every quotient a bin can have.
  constexpr float kCount = 100000.0F;
  PlaceIndex index(SignatureKind::Jeffrey);
  std::vector<Signature> stored;
  for (float share = 1.0F; share > 1e-6F; share *= 0.9F) {
    stored.push_back({SignatureKind::Jeffrey, 1, {kCount * share, 0.0F}});
    index.add(NodeId{static_cast<std::int64_t>(stored.size()) - 1}, stored.back());
  }
  const Signature query{SignatureKind::Jeffrey, 1, {kCount, 0.0F}};
  for (const Match &match : index.nearest(query, stored.size())) {
    const double expected =
        dissimilarity(query, stored[static_cast<std::size_t>(match.node.value)]);
    EXPECT_NEAR(match.dissimilarity, expected, kRelativeError * expected + 1e-9);
  }
}

} // namespace
} // namespace homeward
