// SPDX-License-Identifier: GPL-3.0-or-later
#include "board_views.h"
#include "omnidir.h"

#include <homeward/calib/bundle.h>
#include <homeward/calib/calibration.h>
#include <homeward/calib/convert.h>
#include <homeward/calib/radial_start.h>
#include <homeward/camera/unified_model.h>

#include <benchmark/benchmark.h>

namespace homeward
{
namespace
{

/** 20 views of 54 corners, some of them partial, 0.1 pixels of noise. */
BoardViews views()
{
  const UnifiedModel truth(UnifiedCamera({0.95, 210, 210, 641, 478, -0.05, 0.01}, 1280, 960));
  ViewPlan plan;
  plan.views = 20;
  return takeViews(truth, plan, 1);
}

/** The optimisation alone: camera with distortion and all poses, from a start 5 % off. */
void BM_AdjustBundle(benchmark::State &state)
{
  const BoardViews seen = views();
  CalibrationOptions options;
  options.crossValidate = false;
  const Calibration calibration = calibrate(seen, options);
  Eigen::VectorXd p = calibration.model->parameters();
  p.head<3>() *= 1.05;
  p[3] += 5.0;
  BundleState start{calibration.model->with(p), {}};
  PointMask all;
  for (std::size_t v = 0; v < seen.views.size(); ++v) {
    start.cMo.push_back(Eigen::Translation3d(0.02, -0.01, 0.01) * calibration.views[v].cMo);
    all.emplace_back(seen.views[v].pixels.size(), true);
  }
  BundleOptions bundle;
  bundle.estimated = freeParameters(*start.model, true);
  BundleResult result;
  for (auto _ : state) {
    result = adjustBundle(seen.views, all, start, bundle);
    benchmark::ClobberMemory();
  }
  state.counters["iterations"] = result.iterations;
  state.counters["cost"] = result.cost;
}
BENCHMARK(BM_AdjustBundle)->Unit(benchmark::kMillisecond);

/** From corners to the camera, without a guess; the argument says whether views are left out. */
void BM_Calibrate(benchmark::State &state)
{
  const BoardViews seen = views();
  CalibrationOptions options;
  options.crossValidate = state.range(0) != 0;
  double rms = 0.0;
  for (auto _ : state) {
    rms = calibrate(seen, options).rms;
  }
  state.counters["rms"] = rms;
}
BENCHMARK(BM_Calibrate)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

void BM_RadialCentre(benchmark::State &state)
{
  const BoardViews seen = views();
  for (auto _ : state) {
    benchmark::DoNotOptimize(radialCentre(seen));
  }
}
BENCHMARK(BM_RadialCentre)->Unit(benchmark::kMillisecond);

void BM_RadialStarts(benchmark::State &state)
{
  const BoardViews seen = views();
  for (auto _ : state) {
    benchmark::DoNotOptimize(radialStarts(seen, {640, 480}, 3).size());
  }
}
BENCHMARK(BM_RadialStarts)->Unit(benchmark::kMillisecond);

/** Stock OpenCV on the same corners. */
void BM_CalibrateWithOpencv(benchmark::State &state)
{
  const BoardViews seen = views();
  double rms = 0.0;
  for (auto _ : state) {
    rms = calibrateWithOpencv(seen).rms;
  }
  state.counters["rms"] = rms;
}
BENCHMARK(BM_CalibrateWithOpencv)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace homeward
