// SPDX-License-Identifier: GPL-3.0-or-later
#include "board_picture.h"
#include "test_paths.h"

#include <homeward/calib/board_detector.h>
#include <homeward/core/error.h>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <cstdlib>
#include <numeric>

namespace homeward
{
namespace
{

constexpr int kWidth = 1280;
constexpr int kHeight = 960;

UnifiedCamera camera(double xi)
{
  return {{xi, 284.0 * (1.0 + xi) / 2.0, 284.0 * (1.0 + xi) / 2.0, 651.0, 472.0, 0, 0, 0, 0},
          kWidth,
          kHeight};
}

MirrorCircles mirror()
{
  return {{{651.0, 472.0}, 90.0}, {{651.0, 472.0}, 450.0}};
}

Eigen::Vector3d middleOf(const Target &target)
{
  const auto points = targetPoints(target);
  return std::accumulate(points.begin(), points.end(), Eigen::Vector3d(0.0, 0.0, 0.0)) /
         static_cast<double>(points.size());
}

struct Found
{
  int pictures = 0;
  int boards = 0;
  double rms = 0.0;
  double share = 0.0; ///< of the points inside the ring
};

/** Squared distances of a view's points from the truth. */
std::vector<double> errorsOf(const BoardView &view, const Target &target,
                             const UnifiedCamera &truth, const Eigen::Isometry3d &cMo, bool flip)
{
  const std::vector<Eigen::Vector3d> points = targetPoints(target);
  // A turned grid looks the same and may be counted from its other end.
  const bool turns = target.kind == TargetKind::Chessboard || target.kind == TargetKind::CircleGrid;
  std::vector<double> best;
  for (const bool turned : {false, true}) {
    std::vector<double> squares;
    for (std::size_t i = 0; i < view.pixels.size(); ++i) {
      const auto id = static_cast<std::size_t>(view.ids[i]);
      EXPECT_EQ(view.board[i], points[id]);
      const auto pixel =
          truth.project(cMo * (turned ? points[points.size() - 1 - id] : points[id]));
      const double u = flip ? kWidth - 1.0 - view.pixels[i].x() : view.pixels[i].x();
      squares.push_back((*pixel - Eigen::Vector2d(u, view.pixels[i].y())).squaredNorm());
    }
    const auto sum = [](const auto &v) { return std::accumulate(v.begin(), v.end(), 0.0); };
    if (best.empty() || (turns && sum(squares) < sum(best))) {
      best = squares;
    }
  }
  return best;
}

Found detect(const Target &target, double xi, bool flip, int count = 8)
{
  const UnifiedCamera truth = camera(xi);
  const BoardPainter painter(
      [&](const Eigen::Vector2d &pixel) { return truth.unproject(pixel); },
      {{kWidth, kHeight}, mirror().outer.centre, mirror().inner.radius, mirror().outer.radius},
      target);
  Random random(7, 1);
  Found found;
  std::vector<double> squares;
  for (const Eigen::Isometry3d &cMo : posesRound(count, middleOf(target), 0.4, 0.7, random)) {
    cv::Mat picture = painter.paint(cMo, random);
    MirrorCircles where = mirror();
    if (flip) {
      cv::flip(picture, picture, 1);
      where.inner.centre.x() = where.outer.centre.x() = kWidth - 1.0 - where.outer.centre.x();
    }
    if (const char *folder = std::getenv("HOMEWARD_TEST_PICTURES")) {
      cv::imwrite(std::string(folder) + "/" + nameOf(target.kind) + std::to_string(found.pictures) +
                      ".png",
                  picture);
    }
    ++found.pictures;
    const auto view = findBoard(picture, target, where);
    if (!view) {
      ADD_FAILURE() << "no board in picture " << found.pictures - 1;
      continue;
    }
    ++found.boards;
    found.share += static_cast<double>(view->ids.size()) /
                   static_cast<double>(targetPoints(target).size()) / count;
    const std::vector<double> errors = errorsOf(*view, target, truth, cMo, flip);
    squares.insert(squares.end(), errors.begin(), errors.end());
  }
  found.rms = std::sqrt(std::accumulate(squares.begin(), squares.end(), 0.0) /
                        static_cast<double>(squares.size()));
  return found;
}

struct Case
{
  Target target;
  bool flip;
};

class Detection : public testing::TestWithParam<Case>
{};

TEST_P(Detection, findsEveryBoardToAFractionOfAPixel)
{
  const Found found = detect(GetParam().target, 0.95, GetParam().flip);
  EXPECT_EQ(found.boards, found.pictures);
  EXPECT_LT(found.rms, 0.12);
  EXPECT_GT(found.share, 0.9);
}

INSTANTIATE_TEST_SUITE_P(Targets, Detection,
                         testing::Values(Case{{TargetKind::Chessboard, 9, 6, 0.03}, false},
                                         Case{{TargetKind::CircleGrid, 9, 6, 0.035}, false},
                                         Case{{TargetKind::AprilGrid, 4, 3, 0.09}, false},
                                         Case{{TargetKind::AprilGrid, 4, 3, 0.09}, true},
                                         Case{{TargetKind::Charuco, 7, 5, 0.05}, false},
                                         Case{{TargetKind::Charuco, 7, 5, 0.05}, true}),
                         [](const auto &test) {
                           return nameOf(test.param.target.kind) +
                                  (test.param.flip ? "Flipped" : "");
                         });

TEST(Detection, doesNotDependOnTheNumberOfThreads)
{
  const Target target;
  const UnifiedCamera truth = camera(1.0);
  const BoardPainter painter(
      [&](const Eigen::Vector2d &pixel) { return truth.unproject(pixel); },
      {{kWidth, kHeight}, mirror().outer.centre, mirror().inner.radius, mirror().outer.radius},
      target);
  Random random(3, 1);
  std::vector<cv::Mat> pictures{cv::Mat1b(kHeight, kWidth, 128)};
  for (const Eigen::Isometry3d &cMo : posesRound(3, middleOf(target), 0.4, 0.6, random)) {
    pictures.push_back(painter.paint(cMo, random));
  }
  const auto one = findBoards(pictures, target, mirror(), 1);
  const auto three = findBoards(pictures, target, mirror(), 3);
  ASSERT_EQ(one.size(), pictures.size());
  EXPECT_FALSE(one[0]);
  for (std::size_t i = 1; i < pictures.size(); ++i) {
    ASSERT_TRUE(one[i]);
    EXPECT_EQ(one[i]->pixels, three[i]->pixels);
  }
}

// A sheet that somebody holds beside a real mirror, its top bulging.
TEST(Detection, findsTheBoardInTheRealPicture)
{
  HOMEWARD_NEEDS_OUTSIDE_DATA("mirror/example.jpg");
  const cv::Mat picture =
      cv::imread((outsideDataDir() / "mirror/example.jpg").string(), cv::IMREAD_GRAYSCALE);
  const auto view = findBoard(picture, Target{}, findMirror(picture));
  ASSERT_TRUE(view);
  EXPECT_EQ(view->ids.size(), 54U);
}

TEST(Detection, refusesColour)
{
  EXPECT_THROW(findBoard(cv::Mat(9, 9, CV_8UC3, cv::Scalar()), Target{}, {}), LogicError);
}

} // namespace
} // namespace homeward
