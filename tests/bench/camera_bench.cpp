// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/camera/unwarper.h>

#include <benchmark/benchmark.h>
#include <opencv2/core.hpp>

namespace homeward
{
namespace
{

MirrorCamera nominal()
{
  return {UnifiedCamera({0.95, 108, 108, 319.5, 239.5}, 640, 480), {30.0, 236.0}, {-kPi / 2, true}};
}

/** One mirror picture of 640 x 480 to one panorama of 720 x 160; the argument counts channels. */
void BM_Unwarp(benchmark::State &state)
{
  cv::setNumThreads(1);
  const Unwarper unwarper(nominal(), PanoramaGeometry{});
  cv::Mat picture(480, 640, CV_8UC(static_cast<int>(state.range(0))));
  cv::randu(picture, cv::Scalar::all(0), cv::Scalar::all(256));
  for (auto _ : state) {
    benchmark::DoNotOptimize(unwarper.unwarp(picture).image.data);
  }
}
BENCHMARK(BM_Unwarp)->Arg(1)->Arg(3)->Unit(benchmark::kMicrosecond);

/** The table, once per camera. */
void BM_MakeTable(benchmark::State &state)
{
  const MirrorCamera camera = nominal();
  for (auto _ : state) {
    benchmark::DoNotOptimize(Unwarper(camera, PanoramaGeometry{}).visible().data);
  }
}
BENCHMARK(BM_MakeTable)->Unit(benchmark::kMillisecond);

void BM_ProjectWithJacobians(benchmark::State &state)
{
  const UnifiedCamera camera({1.0, 110, 112, 315, 245, 0.01, 0.001, 1e-3, -2e-3}, 640, 480);
  const Eigen::Vector3d point(0.3, -0.8, 0.4);
  UnifiedCamera::PointJacobian J_point;
  UnifiedCamera::ParameterJacobian J_parameters;
  for (auto _ : state) {
    benchmark::DoNotOptimize(camera.project(point, &J_point, &J_parameters));
  }
}
BENCHMARK(BM_ProjectWithJacobians);

void BM_UnprojectDistorted(benchmark::State &state)
{
  const UnifiedCamera camera({1.0, 110, 112, 315, 245, 0.01, 0.001, 1e-3, -2e-3}, 640, 480);
  const Eigen::Vector2d pixel(410.0, 170.0);
  for (auto _ : state) {
    benchmark::DoNotOptimize(camera.unproject(pixel));
  }
}
BENCHMARK(BM_UnprojectDistorted);

} // namespace
} // namespace homeward
