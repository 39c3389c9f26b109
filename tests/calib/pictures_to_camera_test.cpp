// SPDX-License-Identifier: GPL-3.0-or-later
#include "test_paths.h"

#include <homeward/calib/board_detector.h>
#include <homeward/calib/calibration.h>
#include <homeward/evaluation/rendered_boards.h>
#include <homeward/sim/scene.h>

#include <Eigen/LU>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>

namespace homeward
{
namespace
{

constexpr int kWidth = 1280;
constexpr int kHeight = 960;
constexpr double kRadius = 142.0; ///< f / (1 + xi), pixels

/** The mirror that takes the pictures. */
MirrorCamera mirrorOf(double xi)
{
  UnifiedCamera::Parameters parameters;
  parameters.xi = xi;
  parameters.fx = parameters.fy = kRadius * (1.0 + xi);
  parameters.cx = 651.3;
  parameters.cy = 471.6;
  return {UnifiedCamera(parameters, kWidth, kHeight), {90.0, 450.0}, {-kPi / 2.0, true}};
}

/** In the middle of the laboratory, half a metre from the table. */
BoardStudio studioOf(double xi)
{
  Eigen::Isometry3d wMp = Eigen::Isometry3d::Identity();
  wMp.translation() = Eigen::Vector3d(2.0, -1.5, 1.1);
  return {std::make_shared<const Scene>(loadScene(dataDir() / "worlds/lab.sdf")), wMp,
          mirrorOf(xi)};
}

void keep(const std::vector<cv::Mat> &pictures, const std::string &name)
{
  if (const char *folder = std::getenv("HOMEWARD_TEST_PICTURES")) {
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      cv::imwrite(std::string(folder) + "/" + name + "_" + std::to_string(i) + ".png", pictures[i]);
    }
  }
}

/** Largest angle between the rays of two cameras over the ring, degrees. */
double largestRayError(const MirrorCamera &truth, const CameraModel &model)
{
  double largest = 0.0;
  const auto &parameters = truth.model.parameters();
  for (int v = 0; v < kHeight; v += 12) {
    for (int u = 0; u < kWidth; u += 12) {
      const Eigen::Vector2d pixel(u, v);
      const double radius = (pixel - Eigen::Vector2d(parameters.cx, parameters.cy)).norm();
      if (radius < truth.ring.inner || radius > truth.ring.outer) {
        continue;
      }
      const auto ray = model.unproject(pixel);
      const Eigen::Vector3d expected = *truth.model.unproject(pixel);
      largest = std::max(largest,
                         ray ? degrees(std::atan2(ray->cross(expected).norm(), ray->dot(expected)))
                             : 180.0);
    }
  }
  return largest;
}

Eigen::Index indexOf(const Calibration &calibration, const std::string &name)
{
  const auto names = calibration.model->parameterNames();
  return std::find(names.begin(), names.end(), name) - names.begin();
}

double parameter(const Calibration &calibration, const std::string &name)
{
  return calibration.model->parameters()(indexOf(calibration, name));
}

/** Squared Mahalanobis distance of xi and f, which are only known together, from the truth. */
double distanceFrom(const UnifiedCamera::Parameters &truth, const Calibration &found)
{
  const Eigen::Vector2d off(parameter(found, "xi") - truth.xi, parameter(found, "fx") - truth.fx);
  const std::array<Eigen::Index, 2> both{indexOf(found, "xi"), indexOf(found, "fx")};
  const Eigen::Matrix2d covariance = found.covariance(both, both);
  return off.dot(covariance.inverse() * off);
}

double largestResidual(const Calibration &found)
{
  double largest = 0.0;
  for (const CalibratedView &view : found.views) {
    for (const Eigen::Vector2d &residual : view.residuals) {
      largest = std::max(largest, residual.norm());
    }
  }
  return largest;
}

struct Mirror
{
  double xi;
  TargetKind kind;
  double highest; ///< elevation of the boards, degrees; the rim cuts those that are held high
};

std::ostream &operator<<(std::ostream &out, const Mirror &mirror)
{
  return out << "xi " << mirror.xi << ", " << nameOf(mirror.kind);
}

Target targetOf(TargetKind kind)
{
  switch (kind) {
  case TargetKind::Charuco:
    return {kind, 7, 5, 0.05};
  case TargetKind::AprilGrid:
    return {kind, 5, 4, 0.06};
  default:
    return {kind, 9, 6, 0.033};
  }
}

class PicturesToCamera : public testing::TestWithParam<Mirror>
{};

TEST_P(PicturesToCamera, giveTheTrueMirror)
{
  const auto [xi, kind, highest] = GetParam();
  const BoardStudio studio = studioOf(xi);
  const Target target = targetOf(kind);
  HeldBoards held;
  held.count = 12;
  held.highest = radians(highest);
  const std::vector<cv::Mat> pictures = renderBoards(studio, target, heldBoardPoses(target, held));
  keep(pictures, nameOf(kind) + std::to_string(xi).substr(0, 4));

  BoardViews views{kWidth, kHeight, {}};
  for (const auto &view : findBoards(pictures, target, findMirror(pictures[0]), 2)) {
    if (view) {
      views.views.push_back(*view);
    }
  }
  ASSERT_EQ(views.views.size(), pictures.size());
  const Calibration first = calibrate(views, {.crossValidate = false});
  const Calibration found = calibrate(refineBoards(pictures, target, views, *first.model));
  const auto &truth = studio.camera.model.parameters();
  EXPECT_NEAR(parameter(found, "fx") / (1.0 + parameter(found, "xi")), kRadius, 0.002 * kRadius);
  EXPECT_NEAR(parameter(found, "cx"), truth.cx, 0.002 * kWidth);
  EXPECT_NEAR(parameter(found, "cy"), truth.cy, 0.002 * kHeight);
  constexpr double kThreeSigma = 11.83; // chi-square of two degrees of freedom, 99.73 %
  EXPECT_LT(distanceFrom(truth, found), kThreeSigma);
  const double rayError = largestRayError(studio.camera, *found.model);
  EXPECT_LE(rayError, 0.05);
  EXPECT_LE(found.rms, 0.15);
  EXPECT_LE(largestResidual(found), 0.45); // what the rim cuts is no point
  std::printf("f / (1 + xi) %.3f of %.0f, centre %.2f and %.2f pixels off, rays %.3f degrees, rms "
              "%.3f pixels\n",
              parameter(found, "fx") / (1.0 + parameter(found, "xi")), kRadius,
              parameter(found, "cx") - truth.cx, parameter(found, "cy") - truth.cy, rayError,
              found.rms);
}

INSTANTIATE_TEST_SUITE_P(Mirrors, PicturesToCamera,
                         testing::Values(Mirror{0.8, TargetKind::Charuco, 4.0},
                                         Mirror{0.8, TargetKind::CircleGrid, 4.0},
                                         Mirror{0.95, TargetKind::AprilGrid, 4.0},
                                         Mirror{0.95, TargetKind::Chessboard, 4.0},
                                         Mirror{1.05, TargetKind::Chessboard, 8.0}));

} // namespace
} // namespace homeward
