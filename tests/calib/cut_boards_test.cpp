// SPDX-License-Identifier: GPL-3.0-or-later
#include "board_picture.h"

#include <homeward/calib/board_detector.h>
#include <homeward/camera/unified_camera.h>

#include <gtest/gtest.h>

#include <numeric>

namespace homeward
{
namespace
{

const cv::Size kSize(1280, 960);
constexpr double kInner = 90.0;
constexpr double kOuter = 450.0;
const Eigen::Vector2d kCentre(651.0, 472.0);

UnifiedCamera camera(double xi)
{
  const double f = 142.0 * (1.0 + xi);
  return {{xi, f, f, kCentre.x(), kCentre.y(), 0, 0, 0, 0}, kSize.width, kSize.height};
}

BoardPainter painterOf(const UnifiedCamera &truth, const Target &target)
{
  return {[truth](const Eigen::Vector2d &pixel) { return truth.unproject(pixel); },
          {kSize, kCentre, kInner, kOuter},
          target};
}

/** Where the camera sees the board's corners; nothing beyond the ring. */
std::vector<std::optional<Eigen::Vector2d>>
visible(const Target &target, const UnifiedCamera &truth, const Eigen::Isometry3d &cMo)
{
  std::vector<std::optional<Eigen::Vector2d>> result;
  for (const Eigen::Vector3d &point : targetPoints(target)) {
    auto pixel = truth.project(cMo * point);
    const double radius = pixel ? (*pixel - kCentre).norm() : 0.0;
    result.push_back(radius > kInner && radius < kOuter ? pixel : std::nullopt);
  }
  return result;
}

/** What the views of cut boards are worth. */
struct Outcome
{
  int cut = 0;   ///< boards of which at least a part of 5 x 4 corners or as many shows
  int found = 0; ///< of them
  std::size_t corners = 0;
  std::size_t shown = 0;
  double squares = 0.0; ///< pixels^2, of all corners
};

/** The corner of the board that a pixel shows. */
std::size_t nearest(const std::vector<std::optional<Eigen::Vector2d>> &shown,
                    const Eigen::Vector2d &pixel)
{
  std::size_t best = 0;
  double least = 1e9;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const double away = shown[i] ? (*shown[i] - pixel).norm() : 1e9;
    if (away < least) {
      least = away;
      best = i;
    }
  }
  return best;
}

/** Corners may be counted from anywhere, but must be as far apart on the board as they say. */
void compare(const BoardView &view, const Target &target,
             const std::vector<std::optional<Eigen::Vector2d>> &shown, Outcome &outcome)
{
  const std::vector<Eigen::Vector3d> points = targetPoints(target);
  std::vector<Eigen::Vector3d> truth;
  for (const Eigen::Vector2d &pixel : view.pixels) {
    const std::size_t i = nearest(shown, pixel);
    outcome.squares += shown[i] ? (*shown[i] - pixel).squaredNorm() : 1e9;
    truth.push_back(points[i]);
  }
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_EQ(view.board[i], points[static_cast<std::size_t>(view.ids[i])]);
    for (std::size_t k = 0; k < i; ++k) {
      ASSERT_NEAR((view.board[i] - view.board[k]).norm(), (truth[i] - truth[k]).norm(), 1e-9);
    }
  }
  outcome.corners += view.ids.size();
}

struct Cut
{
  double xi;
  Target target;
};

std::ostream &operator<<(std::ostream &out, const Cut &cut)
{
  return out << "xi " << cut.xi << ", " << nameOf(cut.target.kind);
}

/** Boards round the mirror, the highest of them at an elevation where the mirror ends. */
Outcome lookAtCutBoards(const Cut &cut, double highest)
{
  const auto &[xi, target] = cut;
  const UnifiedCamera truth = camera(xi);
  const BoardPainter painter = painterOf(truth, target);
  Random random(5, 1);
  Outcome outcome;
  for (const auto &cMo : posesRound(12, {0.12, 0.075, 0.0}, 0.3, 0.5, random, highest)) {
    const auto shown = visible(target, truth, cMo);
    const auto count = static_cast<std::size_t>(
        std::count_if(shown.begin(), shown.end(), [](const auto &p) { return p.has_value(); }));
    if (count < 24 || count == shown.size()) {
      continue;
    }
    ++outcome.cut;
    outcome.shown += count;
    const cv::Mat1b picture = painter.paint(cMo, random);
    if (const auto view = findBoard(picture, target, {})) {
      ++outcome.found;
      compare(*view, target, shown, outcome);
    }
  }
  return outcome;
}

class CutBoards : public testing::TestWithParam<Cut>
{};

TEST_P(CutBoards, areFoundAtTheRim)
{
  const Outcome outcome = lookAtCutBoards(GetParam(), radians(28.0));
  EXPECT_GE(outcome.cut, 3);
  EXPECT_EQ(outcome.found, outcome.cut);
  EXPECT_LT(std::sqrt(outcome.squares / static_cast<double>(outcome.corners)), 0.12);
  // Corners beside the rim lack a whole checker, so they do not count.
  EXPECT_GT(outcome.corners, 0.7 * static_cast<double>(outcome.shown));
}

TEST_P(CutBoards, areFoundAtTheInnerCircle)
{
  const Outcome outcome = lookAtCutBoards(GetParam(), radians(-12.0));
  EXPECT_GE(outcome.cut, 3);
  EXPECT_EQ(outcome.found, outcome.cut);
  EXPECT_LT(std::sqrt(outcome.squares / static_cast<double>(outcome.corners)), 0.12);
  EXPECT_GT(outcome.corners, 0.7 * static_cast<double>(outcome.shown));
}

INSTANTIATE_TEST_SUITE_P(Mirrors, CutBoards,
                         testing::Values(Cut{0.8, {}}, Cut{0.95, {}}, Cut{1.05, {}},
                                         Cut{0.95, {TargetKind::Charuco, 9, 7, 0.038}},
                                         Cut{0.95, {TargetKind::AprilGrid, 5, 4, 0.055}},
                                         Cut{0.8, {TargetKind::CircleGrid, 9, 6, 0.03}}));

// A hand is in front of the board's middle: what is on both sides of it is one part or the other.
TEST(CutBoards, areFoundBehindAHand)
{
  const Target target;
  const UnifiedCamera truth = camera(0.95);
  Random random(8, 1);
  const auto poses = posesRound(3, {0.12, 0.075, 0.0}, 0.3, 0.4, random);
  for (const auto &cMo : poses) {
    cv::Mat1b picture = painterOf(truth, target).paint(cMo, random);
    auto shown = visible(target, truth, cMo);
    cv::circle(picture, {cvRound(shown[0]->x()), cvRound(shown[0]->y())}, 45, 140, cv::FILLED);
    const auto view = findBoard(picture, target, {});
    ASSERT_TRUE(view);
    EXPECT_LT(view->ids.size(), shown.size());
    Outcome outcome;
    compare(*view, target, shown, outcome);
    EXPECT_LT(std::sqrt(outcome.squares / static_cast<double>(outcome.corners)), 0.15);
  }
}

// Tiles of a floor may look like checkers, but not like this board's many.
TEST(CutBoards, areNotSeenInAnEmptyRoom)
{
  Random random(9, 1);
  Eigen::Isometry3d behind = Eigen::Isometry3d::Identity();
  behind.translation() = Eigen::Vector3d(0.0, 0.0, -9.0);
  const cv::Mat1b picture = painterOf(camera(0.95), Target{}).paint(behind, random);
  EXPECT_FALSE(findBoard(picture, Target{}, {}));
}

} // namespace
} // namespace homeward
