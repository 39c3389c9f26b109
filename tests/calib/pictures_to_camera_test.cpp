// SPDX-License-Identifier: GPL-3.0-or-later
#include "board_picture.h"

#include <homeward/calib/board_detector.h>
#include <homeward/calib/calibration.h>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <cstdlib>
#include <numeric>

namespace homeward
{
namespace
{

/** A mirror by its geometry: R (cos t + xi) = f sin t, solved for tan(t / 2). \cite Geyer2000 */
struct TrueMirror
{
  double xi;
  double f;
  Eigen::Vector2d centre;

  std::optional<Eigen::Vector3d> ray(const Eigen::Vector2d &pixel) const
  {
    const Eigen::Vector2d m = (pixel - centre) / f;
    const double radius = m.norm();
    const double h =
        radius * (1.0 + xi) / (1.0 + std::sqrt(1.0 + radius * radius * (1.0 - xi * xi)));
    const double sine = 2.0 * h / (1.0 + h * h);
    return radius > 0.0 ? Eigen::Vector3d(m.x() / radius * sine, m.y() / radius * sine,
                                          (1.0 - h * h) / (1.0 + h * h))
                        : Eigen::Vector3d(0.0, 0.0, 1.0);
  }
};

constexpr int kWidth = 1280;
constexpr int kHeight = 960;
constexpr double kInner = 90.0;
constexpr double kOuter = 450.0;

/** What the whole way from pictures to a camera gives. */
struct Outcome
{
  int pictures = 0;
  int boards = 0;
  Calibration calibration;
};

Outcome calibrateFromPictures(const TrueMirror &truth, const Target &target, int count,
                              double highest)
{
  const BoardPainter painter([&](const Eigen::Vector2d &pixel) { return truth.ray(pixel); },
                             {{kWidth, kHeight}, truth.centre, kInner, kOuter}, target);
  const auto points = targetPoints(target);
  const Eigen::Vector3d middle =
      std::accumulate(points.begin(), points.end(), Eigen::Vector3d(0.0, 0.0, 0.0)) /
      static_cast<double>(points.size());
  Random random(11, 1);
  std::vector<cv::Mat> pictures;
  for (const Eigen::Isometry3d &cMo : posesRound(count, middle, 0.32, 0.6, random, highest)) {
    pictures.push_back(painter.paint(cMo, random));
    if (const char *folder = std::getenv("HOMEWARD_TEST_PICTURES")) {
      cv::imwrite(std::string(folder) + "/" + nameOf(target.kind) +
                      std::to_string(truth.xi).substr(0, 4) + "_" +
                      std::to_string(pictures.size()) + ".png",
                  pictures.back());
    }
  }
  Outcome outcome{count, 0, {}};
  BoardViews views{kWidth, kHeight, {}};
  for (const auto &view : findBoards(pictures, target, findMirror(pictures[0]), 2)) {
    if (view) {
      ++outcome.boards;
      views.views.push_back(*view);
    }
  }
  outcome.calibration = calibrate(views);
  return outcome;
}

/** Largest angle between the rays of two cameras over the ring, degrees. */
double largestRayError(const TrueMirror &truth, const CameraModel &model)
{
  double largest = 0.0;
  for (int v = 0; v < kHeight; v += 12) {
    for (int u = 0; u < kWidth; u += 12) {
      const Eigen::Vector2d pixel(u, v);
      const double radius = (pixel - truth.centre).norm();
      if (radius < kInner || radius > kOuter) {
        continue;
      }
      const auto ray = model.unproject(pixel);
      const Eigen::Vector3d expected = *truth.ray(pixel);
      largest = std::max(largest,
                         ray ? degrees(std::atan2(ray->cross(expected).norm(), ray->dot(expected)))
                             : 180.0);
    }
  }
  return largest;
}

double parameter(const Calibration &calibration, const std::string &name, double *sigma = nullptr)
{
  const auto names = calibration.model->parameterNames();
  const auto i = std::find(names.begin(), names.end(), name) - names.begin();
  if (sigma != nullptr) {
    *sigma = std::sqrt(calibration.covariance(i, i));
  }
  return calibration.model->parameters()(i);
}

struct Mirror
{
  double xi;
  TargetKind kind;
  double highest; ///< degrees; a chessboard must be seen whole, below the rim, markers need not
};

std::ostream &operator<<(std::ostream &out, const Mirror &mirror)
{
  return out << "xi " << mirror.xi << ", " << nameOf(mirror.kind);
}

class PicturesToCamera : public testing::TestWithParam<Mirror>
{};

TEST_P(PicturesToCamera, giveTheTrueMirror)
{
  const auto [xi, kind, highest] = GetParam();
  const TrueMirror truth{xi, 142.0 * (1.0 + xi), {651.3, 471.6}};
  const Target target =
      kind == TargetKind::Charuco ? Target{kind, 7, 5, 0.05} : Target{kind, 9, 6, 0.03};
  const Outcome outcome = calibrateFromPictures(truth, target, 16, radians(highest));
  EXPECT_EQ(outcome.boards, outcome.pictures);
  const Calibration &found = outcome.calibration;
  double sigmaXi = 0.0;
  double sigmaF = 0.0;
  const double foundXi = parameter(found, "xi", &sigmaXi);
  const double foundF = parameter(found, "fx", &sigmaF);
  EXPECT_NEAR(foundF / (1.0 + foundXi), 142.0, 0.002 * 142.0);
  EXPECT_NEAR(parameter(found, "cx"), truth.centre.x(), 0.002 * kWidth);
  EXPECT_NEAR(parameter(found, "cy"), truth.centre.y(), 0.002 * kHeight);
  EXPECT_LT(std::abs(foundXi - xi), 3.0 * sigmaXi);
  EXPECT_LT(std::abs(foundF - truth.f), 3.0 * sigmaF);
  EXPECT_LE(largestRayError(truth, *found.model), 0.05);
  EXPECT_LE(found.rms, 0.15);
}

INSTANTIATE_TEST_SUITE_P(Mirrors, PicturesToCamera,
                         testing::Values(Mirror{0.8, TargetKind::Charuco, 0.0},
                                         Mirror{0.95, TargetKind::Chessboard, 4.0},
                                         Mirror{1.05, TargetKind::Chessboard, 8.0}));

} // namespace
} // namespace homeward
