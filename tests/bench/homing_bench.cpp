// SPDX-License-Identifier: GPL-3.0-or-later
#include "../support/synthetic_room.h"

#include <homeward/homing/min_warping.h>
#include <homeward/homing/scale_space_homing.h>
#include <homeward/homing/visual_compass.h>

#include <benchmark/benchmark.h>
#include <opencv2/core.hpp>

namespace homeward
{
namespace
{

/** Two views of a painted room, 720 x 180, a metre apart and turned. */
struct Views
{
  Panorama current;
  Panorama snapshot;

  Views()
  {
    const SyntheticRoom room(5, 8.0, 6.0);
    const PanoramaGeometry geometry{720, 180, radians(-45.0), radians(45.0)};
    current = room.view({1.0, 0.5, 0.8}, {}, geometry);
    snapshot = room.view({0.2, -0.1, -0.3}, {}, geometry);
  }
};

const Views &views()
{
  static const Views instance;
  return instance;
}

/** The comparison of two prepared panoramas: scale planes, search both ways round, refinement. */
void matchWith(benchmark::State &state, const MinWarpingOptions &options)
{
  const MinWarping method(options);
  const ColumnFeatures current = method.prepare(views().current);
  const ColumnFeatures snapshot = method.prepare(views().snapshot);
  for (auto _ : state) {
    benchmark::DoNotOptimize(method.match(current, snapshot));
  }
}

MinWarpingOptions withColumns(int columns)
{
  MinWarpingOptions options;
  options.columns = columns;
  return options;
}

void BM_MinWarping72(benchmark::State &state)
{
  matchWith(state, withColumns(72));
}
BENCHMARK(BM_MinWarping72)->Unit(benchmark::kMillisecond);

void BM_MinWarping144x80Double(benchmark::State &state)
{
  matchWith(state, withColumns(144));
}
BENCHMARK(BM_MinWarping144x80Double)->Unit(benchmark::kMillisecond);

/** 9 planes, 96 x 96 directions and heading changes, both ways round. */
void BM_MinWarping288Search96(benchmark::State &state)
{
  MinWarpingOptions options = withColumns(288);
  options.searchStep = 3;
  matchWith(state, options);
}
BENCHMARK(BM_MinWarping288Search96)->Unit(benchmark::kMillisecond);

void BM_MinWarping288(benchmark::State &state)
{
  matchWith(state, withColumns(288));
}
BENCHMARK(BM_MinWarping288)->Unit(benchmark::kMillisecond);

/** What a panorama costs once, whatever it is compared with. */
void BM_MinWarpingPrepare(benchmark::State &state)
{
  const MinWarping method(withColumns(static_cast<int>(state.range(0))));
  for (auto _ : state) {
    benchmark::DoNotOptimize(method.prepare(views().current));
  }
}
BENCHMARK(BM_MinWarpingPrepare)->Arg(72)->Arg(144)->Unit(benchmark::kMillisecond);

void BM_ZeilCompass(benchmark::State &state)
{
  cv::setNumThreads(1);
  for (auto _ : state) {
    benchmark::DoNotOptimize(visualCompass(views().current, views().snapshot, kZeilCompass));
  }
}
BENCHMARK(BM_ZeilCompass)->Unit(benchmark::kMillisecond);

void BM_VisualCompass(benchmark::State &state)
{
  cv::setNumThreads(1);
  for (auto _ : state) {
    benchmark::DoNotOptimize(visualCompass(views().current, views().snapshot));
  }
}
BENCHMARK(BM_VisualCompass)->Unit(benchmark::kMillisecond);

/** The whole of a pair; the first argument counts OpenCV's threads, the second tells the published
 * way. */
void BM_ScaleSpaceHoming(benchmark::State &state)
{
  cv::setNumThreads(static_cast<int>(state.range(0)));
  ScaleSpaceOptions options;
  options.published = state.range(1) != 0;
  ScaleSpaceHoming method(options);
  for (auto _ : state) {
    benchmark::DoNotOptimize(method.compute(views().current, views().snapshot));
  }
}
BENCHMARK(BM_ScaleSpaceHoming)
    ->ArgNames({"threads", "published"})
    ->ArgsProduct({{1, 2}, {0, 1}})
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

} // namespace
} // namespace homeward
