// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/random.h>
#include <homeward/place/histogram.h>
#include <homeward/place/place_index.h>

#include <benchmark/benchmark.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <map>

// Times are processor time, which other programs do not lengthen much; repeat and take the least:
//   bench_place --benchmark_repetitions=10 --benchmark_report_aggregates_only=false

namespace homeward
{
namespace
{

constexpr int kPixels = 20000;

/** Something like the gray histogram of a room: a few heaps of gray levels, all bins whole. */
Signature drawHistogram(Random &random, SignatureKind kind)
{
  Signature signature{kind, kPixels, std::vector<float>(256, 1.0F)};
  for (int heap = 0; heap < 4; ++heap) {
    const double middle = random.uniform(0.0, 256.0);
    const double width = random.uniform(5.0, 40.0);
    for (std::size_t k = 0; k < signature.values.size(); ++k) {
      const double x = (static_cast<double>(k) - middle) / width;
      signature.values[k] += static_cast<float>(std::floor(100.0 * std::exp(-x * x)));
    }
  }
  return signature;
}

Signature drawBytes(Random &random)
{
  Signature signature{SignatureKind::EdgeBytes, kPixels, std::vector<float>(256)};
  for (float &value : signature.values) {
    value = static_cast<float>(std::floor(random.uniform(0.0, 256.0)));
  }
  return signature;
}

PlaceIndex indexOfHistograms(SignatureKind kind, std::int64_t nodes)
{
  Random random(7, 0);
  PlaceIndex index(kind);
  for (std::int64_t id = 0; id < nodes; ++id) {
    index.add(NodeId{id}, drawHistogram(random, kind));
  }
  return index;
}

constexpr std::int64_t kNodes = 1000;

/** OpenCV's Kullback-Leibler loop over the same histograms: what Jeffrey is measured against. */
void BM_OpenCvKullbackLeibler(benchmark::State &state)
{
  Random random(7, 0);
  std::vector<cv::Mat> stored;
  for (std::int64_t id = 0; id < kNodes; ++id) {
    stored.push_back(cv::Mat(drawHistogram(random, SignatureKind::Jeffrey).values, true));
  }
  const cv::Mat query(drawHistogram(random, SignatureKind::Jeffrey).values, true);
  for (auto _ : state) {
    double least = 1e300;
    for (const cv::Mat &histogram : stored) {
      least = std::min(least, cv::compareHist(query, histogram, cv::HISTCMP_KL_DIV));
    }
    benchmark::DoNotOptimize(least);
  }
}
BENCHMARK(BM_OpenCvKullbackLeibler)->Unit(benchmark::kMicrosecond);

/** One query against 1,000 nodes, one thread. */
void BM_Histogram(benchmark::State &state, SignatureKind kind)
{
  const PlaceIndex index = indexOfHistograms(kind, kNodes);
  Random random(8, 0);
  const Signature query = drawHistogram(random, kind);
  for (auto _ : state) {
    benchmark::DoNotOptimize(index.nearest(query, 20).data());
  }
  state.counters["bytes_per_node"] = static_cast<double>(index.bytesPerNode());
}
BENCHMARK_CAPTURE(BM_Histogram, jeffrey, SignatureKind::Jeffrey)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(BM_Histogram, chi_square, SignatureKind::ChiSquare)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(BM_Histogram, sad, SignatureKind::AbsoluteDifferences)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(BM_Histogram, hellinger, SignatureKind::Hellinger)->Unit(benchmark::kMicrosecond);

/** One query of aligned edges, as long as makeSignature() makes them, against 1,000 nodes. */
void BM_AlignedEdges(benchmark::State &state)
{
  constexpr std::size_t kSpectra = 32;
  Random random(11, 0);
  const auto draw = [&random] {
    Signature drawn{SignatureKind::AlignedEdges, kPixels,
                    std::vector<float>(2 * kTurnFrequencies * kSpectra)};
    std::generate(drawn.values.begin(), drawn.values.end(),
                  [&random] { return static_cast<float>(random.normal(1.0)); });
    return drawn;
  };
  PlaceIndex index(SignatureKind::AlignedEdges);
  for (std::int64_t id = 0; id < kNodes; ++id) {
    index.add(NodeId{id}, draw());
  }
  const Signature query = draw();
  for (auto _ : state) {
    benchmark::DoNotOptimize(index.nearest(query, 20).data());
  }
  state.counters["bytes_per_node"] = static_cast<double>(index.bytesPerNode());
}
BENCHMARK(BM_AlignedEdges)->Unit(benchmark::kMicrosecond);

constexpr std::int64_t kMillion = 1000000;

/** A million places of 256 bytes, made once a number of threads. */
const PlaceIndex &million(int threads)
{
  static std::map<int, PlaceIndex> made;
  const auto [found, fresh] =
      made.try_emplace(threads, SignatureKind::EdgeBytes, PlaceIndexOptions{.threads = threads});
  if (fresh) {
    Random random(9, 0);
    const Signature first = drawBytes(random);
    found->second.reserve(kMillion);
    Signature drawn = first;
    for (std::int64_t id = 0; id < kMillion; ++id) {
      drawn.values[static_cast<std::size_t>(id) % 256] = static_cast<float>(id % 251);
      found->second.add(NodeId{id}, drawn);
    }
  }
  return found->second;
}

/** One query against 1,000,000 nodes of the form in bytes; the argument counts threads. */
void BM_Million(benchmark::State &state)
{
  const PlaceIndex &index = million(static_cast<int>(state.range(0)));
  Random random(10, 0);
  const Signature query = drawBytes(random);
  for (auto _ : state) {
    benchmark::DoNotOptimize(index.nearest(query, 20).data());
  }
  state.SetBytesProcessed(state.iterations() * kMillion *
                          static_cast<std::int64_t>(index.bytesPerNode()));
}
BENCHMARK(BM_Million)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

/** What the memory gives at best to one thread: the sum of as many bytes as the million takes. */
void BM_MemoryBandwidth(benchmark::State &state)
{
  const std::vector<std::uint64_t> words(static_cast<std::size_t>(kMillion) * 32, 1);
  for (auto _ : state) {
    std::uint64_t sum = 0;
    for (const std::uint64_t word : words) {
      sum += word;
    }
    benchmark::DoNotOptimize(sum);
  }
  state.SetBytesProcessed(state.iterations() * kMillion * 256);
}
BENCHMARK(BM_MemoryBandwidth)->ThreadRange(1, 2)->UseRealTime()->Unit(benchmark::kMillisecond);

/** The signature of a panorama of 720 x 180. */
void BM_MakeSignature(benchmark::State &state)
{
  cv::setNumThreads(1);
  const PanoramaGeometry geometry{.width = 720, .height = 180};
  Panorama panorama{cv::Mat(geometry.height, geometry.width, CV_8UC3), geometry};
  cv::randu(panorama.image, cv::Scalar::all(0), cv::Scalar::all(256));
  const auto kind = static_cast<SignatureKind>(state.range(0));
  Signature signature;
  for (auto _ : state) {
    signature = makeSignature(panorama, kind);
  }
  state.SetLabel(std::string(name(kind)));
  state.counters["bytes"] = static_cast<double>(byteSize(signature));
}
BENCHMARK(BM_MakeSignature)
    ->DenseRange(0, static_cast<int>(signatureKinds().size()) - 1)
    ->Unit(benchmark::kMicrosecond);

} // namespace
} // namespace homeward
