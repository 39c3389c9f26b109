// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/evaluation/place_score.h>

#include <algorithm>

namespace homeward
{

namespace
{

bool rightAmong(const PlaceAnswer &answer, std::size_t count)
{
  const auto end =
      answer.right.begin() + static_cast<std::ptrdiff_t>(std::min(count, answer.right.size()));
  return std::find(answer.right.begin(), end, true) != end;
}

/** Answers that a threshold accepts one after the other; those as sure as each other go together.
 */
void scoreThresholds(std::vector<PlaceAnswer> answers, PlaceScore &score)
{
  const auto known = static_cast<double>(score.queries);
  std::sort(answers.begin(), answers.end(),
            [](const PlaceAnswer &a, const PlaceAnswer &b) { return a.unlikeness < b.unlikeness; });
  double right = 0.0;
  double accepted = 0.0;
  double lastRecall = 0.0;
  for (std::size_t i = 0; i < answers.size();) {
    const double threshold = answers[i].unlikeness;
    for (; i < answers.size() && answers[i].unlikeness <= threshold; ++i) {
      accepted += 1.0;
      right += rightAmong(answers[i], 1) ? 1.0 : 0.0;
    }
    const double recall = right / known;
    score.aucPr += right / accepted * (recall - lastRecall);
    lastRecall = recall;
    if (right == accepted) {
      score.recallAtFullPrecision = recall;
    }
  }
}

} // namespace

PlaceScore scorePlaces(const std::vector<PlaceAnswer> &answers)
{
  PlaceScore score;
  score.queries = static_cast<std::size_t>(std::count_if(
      answers.begin(), answers.end(), [](const PlaceAnswer &answer) { return answer.known; }));
  if (score.queries == 0) {
    return score;
  }
  const auto share = [&](std::size_t among) {
    const auto found =
        std::count_if(answers.begin(), answers.end(),
                      [&](const PlaceAnswer &answer) { return rightAmong(answer, among); });
    return static_cast<double>(found) / static_cast<double>(score.queries);
  };
  score.recallAt1 = share(1);
  score.recallAt5 = share(5);
  score.recallAt20 = share(20);
  std::vector<PlaceAnswer> given;
  std::copy_if(answers.begin(), answers.end(), std::back_inserter(given),
               [](const PlaceAnswer &answer) { return !answer.right.empty(); });
  score.confusion.assign(kConfusionDistances.size() + 1, 0.0);
  for (const PlaceAnswer &answer : given) {
    const auto *const bin =
        std::lower_bound(kConfusionDistances.begin(), kConfusionDistances.end(), answer.distance);
    score.confusion[static_cast<std::size_t>(bin - kConfusionDistances.begin())] +=
        1.0 / static_cast<double>(given.size());
  }
  scoreThresholds(std::move(given), score);
  return score;
}

} // namespace homeward
