// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/random.h>
#include <homeward/pilot/place_memory.h>
#include <homeward/run/run_mission.h>

#include <benchmark/benchmark.h>
#include <opencv2/imgproc.hpp>

#include <filesystem>
#include <unistd.h>

// What an exploration computes between one drive and the next, on a map as large as it may grow:
// recognising the view among all places, deciding, and storing a new place. Bound: 0.2 s.

namespace homeward
{
namespace
{

constexpr int kSide = 20; // 400 places
constexpr int kViews = 24;

Direction direction(int id, double bearing, DirectionState state)
{
  return {DirectionId{id}, bearing, 1.0, state, state == DirectionState::Open ? "" : "driven"};
}

/** A square grid of places 2 m apart, explored but for one direction in the far corner. */
TopologicalMap gridMap()
{
  TopologicalMap map;
  for (int i = 0; i < kSide * kSide; ++i) {
    const bool last = i + 1 == kSide * kSide;
    map.apply(NodeAdded{
        {NodeId{i},
         {direction(0, 0.0, DirectionState::Driven),
          direction(1, kPi / 2.0, last ? DirectionState::Open : DirectionState::Driven)}}});
  }
  const auto join = [&](int a, int b, double bearing) {
    map.apply(EdgeAdded{
        {map.nextEdgeId(), NodeId{a}, NodeId{b}, bearing, wrapAngle(bearing + kPi), 2.0}});
  };
  for (int row = 0; row < kSide; ++row) {
    for (int column = 0; column < kSide; ++column) {
      const int here = row * kSide + column;
      if (column + 1 < kSide) {
        join(here, here + 1, 0.0);
      }
      if (row + 1 < kSide) {
        join(here, here + kSide, kPi / 2.0);
      }
    }
  }
  return map;
}

/** Something with soft edges, as walls and shelves have; no two alike. */
Panorama drawView(Random &random)
{
  Panorama view;
  view.geometry = PilotOptions{}.panorama;
  view.image.create(view.geometry.height, view.geometry.width, CV_8UC1);
  for (auto pixel = view.image.begin<unsigned char>(); pixel != view.image.end<unsigned char>();
       ++pixel) {
    *pixel = static_cast<unsigned char>(random.uniform(0.0, 255.0));
  }
  cv::GaussianBlur(view.image, view.image, {}, 6.0);
  cv::normalize(view.image, view.image, 0, 255, cv::NORM_MINMAX);
  return view;
}

/** A robot two metres on from the first place, that looks at ten likely ones. */
struct Looking
{
  TopologicalMap map = gridMap();
  ExplorerState state;
  Recognised seen;

  Looking()
  {
    state.phase = ExplorerState::Phase::Classifying;
    state.origin = NodeId{0};
    state.direction = DirectionId{1};
    state.chord = {1.9, 2.0, 0.7, -2.4};
    for (int i = 0; i < 10; ++i) {
      seen.matches.push_back({NodeId{i * kSide + 2 * i}, 0.3, false, 300.0});
    }
  }
};

void BM_RecogniseAmong400(benchmark::State &state)
{
  Random random(5, 0);
  PlaceMemory memory({});
  for (int i = 0; i < kSide * kSide; ++i) {
    memory.add(NodeId{i}, drawView(random));
  }
  const Panorama now = drawView(random);
  for (auto _ : state) {
    benchmark::DoNotOptimize(memory.recognise(now));
  }
}

void BM_DecideAmong400(benchmark::State &state)
{
  const Explorer explorer({});
  const Looking looking;
  for (auto _ : state) {
    benchmark::DoNotOptimize(explorer.next(looking.state, looking.map, looking.seen));
  }
}

/** The last place is reached and there is nothing left but far away: it plans. */
void BM_PlanAmong400(benchmark::State &state)
{
  const Explorer explorer({});
  Looking looking;
  looking.state.phase = ExplorerState::Phase::Homing;
  looking.state.target = NodeId{0};
  const Homed arrived{HomingEnd::Arrived, looking.state.chord};
  for (auto _ : state) {
    benchmark::DoNotOptimize(explorer.next(looking.state, looking.map, arrived));
  }
}

void BM_StoreOnTopOf400(benchmark::State &state)
{
  const auto path = std::filesystem::temp_directory_path() /
                    ("homeward-mission-bench-" + std::to_string(getpid()) + ".hwm");
  Random random(6, 0);
  std::vector<ViewBytes> views;
  views.reserve(kViews);
  for (int i = 0; i < kViews; ++i) {
    views.push_back(encodeView(drawView(random)));
  }
  {
    MapHeader header;
    header.cameraHash = "none";
    header.panorama = PilotOptions{}.panorama;
    header.signatureKind = "aligned_edges";
    MapFile file = MapFile::create(path, header, MapFile::IfExists::Replace);
    const auto add = [&](std::int64_t id) {
      const ViewBytes &view = views[static_cast<std::size_t>(id % kViews)];
      file.append({.changes = {NodeAdded{{NodeId{id}, {}}}},
                   .view = NewView{NodeId{id}, view},
                   .log = {{1.0, "Exploration"}},
                   .values = keptValues(Looking{}.state)});
    };
    std::int64_t id = 0;
    for (; id < static_cast<std::int64_t>(kSide) * kSide; ++id) {
      add(id);
    }
    for (auto _ : state) {
      add(id++);
    }
  }
  std::filesystem::remove(path);
}

BENCHMARK(BM_RecogniseAmong400)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_DecideAmong400)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_PlanAmong400)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_StoreOnTopOf400)->Unit(benchmark::kMillisecond)->Iterations(100)->UseRealTime();

} // namespace
} // namespace homeward
