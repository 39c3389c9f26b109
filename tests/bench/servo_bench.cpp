// SPDX-License-Identifier: GPL-3.0-or-later
#include "../support/synthetic_room.h"

#include <homeward/camera/unwarper.h>
#include <homeward/homing/min_warping.h>
#include <homeward/servo/homing_servo.h>
#include <homeward/servo/photometric_offset.h>

#include <benchmark/benchmark.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace homeward
{
namespace
{

MirrorCamera mirrorCamera()
{
  return {UnifiedCamera({0.95, 108, 108, 319.5, 239.5}, 640, 480), {30.0, 236.0}, {-kPi / 2, true}};
}

Panorama viewFrom(const Pose2 &pose)
{
  static const SyntheticRoom room(5, 8.0, 6.0);
  return room.view(pose, {}, PanoramaGeometry{});
}

/** What the mirror camera shows where a panorama is seen: rows are circles about the middle. */
cv::Mat mirrorPicture(const Panorama &panorama)
{
  cv::Mat picture;
  cv::Mat turned;
  cv::rotate(panorama.image, turned, cv::ROTATE_90_CLOCKWISE);
  cv::warpPolar(turned, picture, {640, 480}, {319.5F, 239.5F}, 236.0,
                cv::INTER_LINEAR | cv::WARP_INVERSE_MAP);
  cv::cvtColor(picture, picture, cv::COLOR_GRAY2BGR);
  return picture;
}

/** From a picture of the mirror to (v, w), as on the robot: unwarp, home vector, visual servo. */
void BM_ControlTick(benchmark::State &state)
{
  cv::setNumThreads(1);
  const Unwarper unwarper(mirrorCamera(), PanoramaGeometry{});
  const cv::Mat picture = mirrorPicture(viewFrom({1.0, 0.5, 0.8}));
  const Panorama home = unwarper.unwarp(mirrorPicture(viewFrom({0.2, -0.1, -0.3})));
  MinWarping method;
  HomingServo servo(Eigen::Isometry3d::Identity());
  for (auto _ : state) {
    const std::optional<HomeVector> seen = method.compute(unwarper.unwarp(picture), home);
    benchmark::DoNotOptimize(servo.approach(seen.value()));
  }
}
BENCHMARK(BM_ControlTick)->Unit(benchmark::kMillisecond);

void BM_PhotometricOffset(benchmark::State &state)
{
  cv::setNumThreads(1);
  const Panorama current = viewFrom({0.25, -0.08, -0.2});
  const Panorama home = viewFrom({0.2, -0.1, -0.3});
  for (auto _ : state) {
    benchmark::DoNotOptimize(photometricOffset(current, home));
  }
}
BENCHMARK(BM_PhotometricOffset)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace homeward
