// SPDX-License-Identifier: GPL-3.0-or-later
#include "synthetic_room.h"

#include <homeward/evaluation/place_score.h>
#include <homeward/evaluation/place_trial.h>

#include <gtest/gtest.h>

namespace homeward
{
namespace
{

PlaceAnswer answer(std::vector<bool> right, double unlikeness, bool known = true)
{
  return {std::move(right), unlikeness, known};
}

TEST(PlaceScore, recallAmongTheFirst)
{
  std::vector<bool> sixth(20, false);
  sixth[5] = true;
  const PlaceScore score = scorePlaces({answer({true, false}, 0.1), answer({false, true}, 0.2),
                                        answer(sixth, 0.3), answer({false, false}, 0.4)});
  EXPECT_EQ(score.queries, 4U);
  EXPECT_DOUBLE_EQ(score.recallAt1, 0.25);
  EXPECT_DOUBLE_EQ(score.recallAt5, 0.5);
  EXPECT_DOUBLE_EQ(score.recallAt20, 0.75);
}

TEST(PlaceScore, thresholdsByHand)
{
  // By sureness: right, right, wrong, right. Precision 1, 1, 2/3, 3/4 at recall 1/4, 2/4, 2/4, 3/4.
  const PlaceScore score = scorePlaces(
      {answer({true}, 0.4), answer({true}, 0.1), answer({false}, 0.3), answer({true}, 0.2)});
  EXPECT_DOUBLE_EQ(score.recallAtFullPrecision, 0.5);
  EXPECT_DOUBLE_EQ(score.aucPr, 0.25 + 0.25 + 0.25 * 0.75);
}

TEST(PlaceScore, equallySureAnswersAreAcceptedTogether)
{
  const PlaceScore score = scorePlaces({answer({true}, 0.1), answer({false}, 0.1)});
  EXPECT_DOUBLE_EQ(score.recallAtFullPrecision, 0.0);
  EXPECT_DOUBLE_EQ(score.aucPr, 0.25);
}

TEST(PlaceScore, anUnknownPlaceCountsOnlyWhereAccepted)
{
  const PlaceScore late = scorePlaces({answer({true}, 0.1), answer({false}, 0.9, false)});
  EXPECT_EQ(late.queries, 1U);
  EXPECT_DOUBLE_EQ(late.recallAt1, 1.0);
  EXPECT_DOUBLE_EQ(late.recallAtFullPrecision, 1.0);
  const PlaceScore early = scorePlaces({answer({true}, 0.1), answer({false}, 0.05, false)});
  EXPECT_DOUBLE_EQ(early.recallAtFullPrecision, 0.0);
}

TEST(PlaceScore, confusionIsCountedByDistance)
{
  std::vector<PlaceAnswer> answers(4, answer({true}, 0.1));
  const std::array distances{0.3, 0.9, 3.0, 20.0};
  for (std::size_t i = 0; i < answers.size(); ++i) {
    answers[i].distance = distances.at(i);
  }
  EXPECT_EQ(scorePlaces(answers).confusion, (std::vector{0.25, 0.25, 0.0, 0.25, 0.0, 0.25}));
}

TEST(PlaceScore, nothingKnownIsNothingFound)
{
  EXPECT_EQ(scorePlaces({answer({}, 0.0, false)}).queries, 0U);
  EXPECT_DOUBLE_EQ(scorePlaces({}).aucPr, 0.0);
}

/** Views on a line through a room, half a metre apart. */
PlaceViews row(const SyntheticRoom &room, double offset, double heading)
{
  PlaceViews views;
  for (int i = 0; i < 6; ++i) {
    views.poses.push_back({-1.25 + 0.5 * i + offset, 0.3, heading + i});
    views.panoramas.push_back(room.view(views.poses.back(), {}, {.width = 360, .height = 80}));
  }
  return views;
}

TEST(PlaceTrial, findsViewsNextToKnownOnes)
{
  const SyntheticRoom room(41, 6.0, 5.0);
  const PlaceViews known = row(room, 0.0, 0.2);
  const PlaceViews queries = row(room, 0.05, 2.0);
  for (const int threads : {1, 2}) {
    const PlaceTrial trial(known, queries, {.sameDistance = 0.1, .threads = threads});
    const PlaceFigures figures = trial.bySignature(SignatureKind::EdgeFourier);
    EXPECT_EQ(figures.score.queries, 6U);
    EXPECT_GE(figures.score.recallAt1, 0.8);
    EXPECT_EQ(figures.bytes, 10U * 30U * 4U);
    EXPECT_DOUBLE_EQ(trial.byWarping(SignatureKind::AbsoluteDifferences).score.recallAt1, 1.0);
    const PlaceFigures aligned = trial.byWarping(SignatureKind::AlignedEdges);
    EXPECT_DOUBLE_EQ(aligned.score.recallAt1, 1.0);
    const PlaceTrial metre(known, queries, {.sameDistance = 1.1, .threads = threads});
    const auto sure = metre.byWarping(SignatureKind::AlignedEdges).sure;
    ASSERT_TRUE(sure.has_value());
    EXPECT_GE(sure->matches, 6U);
    EXPECT_EQ(sure->right, sure->matches);
  }
}

TEST(PlaceTrial, aKnownViewIsNotFoundInItself)
{
  const SyntheticRoom room(41, 6.0, 5.0);
  const PlaceViews known = row(room, 0.0, 0.2);
  EXPECT_EQ(PlaceTrial(known, known, {.sameDistance = 0.1})
                .bySignature(SignatureKind::Fourier)
                .score.queries,
            0U);
  EXPECT_EQ(PlaceTrial(known, known, {.sameDistance = 0.6})
                .bySignature(SignatureKind::Fourier)
                .score.queries,
            6U);
}

} // namespace
} // namespace homeward
