// SPDX-License-Identifier: GPL-3.0-or-later
#include "../drivers/fake_pioneer.h"

#include <homeward/drivers/pioneer_base.h>
#include <homeward/drivers/protocol/arcos.h>
#include <homeward/drivers/protocol/sick.h>

#include <benchmark/benchmark.h>

namespace homeward
{
namespace
{

/** As a Pioneer 3-AT sends it: 16 sonars, the full tail, 89 bytes. */
ArcosSip fullSip()
{
  ArcosSip sip;
  sip.moving = true;
  sip.x = 1234;
  sip.heading = -300;
  sip.leftSpeed = 200;
  sip.rightSpeed = 210;
  sip.battery = 130;
  sip.flags = 0x1F;
  sip.turnRate = 12;
  for (std::uint8_t i = 0; i < 16; ++i) {
    sip.sonars.push_back({i, static_cast<std::uint16_t>(500 + i)});
  }
  return sip;
}

void countPackets(benchmark::State &state, std::size_t packets)
{
  state.counters["packets"] = benchmark::Counter(static_cast<double>(packets),
                                                 benchmark::Counter::kIsIterationInvariantRate);
}

/** Commands through frame, reader and argument, as a simulated robot takes them. */
void BM_Commands(benchmark::State &state)
{
  constexpr std::size_t kCount = 1000;
  Bytes stream;
  for (std::size_t i = 0; i < kCount; ++i) {
    const Bytes frame = frameArcos(arcosCommand(ArcosCommand::Vel, static_cast<int>(i)));
    stream.insert(stream.end(), frame.begin(), frame.end());
  }
  for (auto _ : state) {
    ArcosReader reader;
    int sum = 0;
    for (std::size_t at = 0; at < stream.size(); at += 90) {
      reader.push(std::span(stream).subspan(at, std::min<std::size_t>(90, stream.size() - at)),
                  Time{});
      while (const auto packet = reader.next()) {
        sum += arcosArgument(*packet).value_or(0);
      }
    }
    benchmark::DoNotOptimize(sum);
  }
  countPackets(state, kCount);
}
BENCHMARK(BM_Commands);

/** Information packets of 89 bytes, one read each, as a driver takes them. */
void BM_InformationPackets(benchmark::State &state)
{
  constexpr std::size_t kCount = 1000;
  const Bytes frame = frameArcos(encodeSip(fullSip()));
  for (auto _ : state) {
    ArcosReader reader;
    int sum = 0;
    for (std::size_t i = 0; i < kCount; ++i) {
      reader.push(frame, Time{});
      while (const auto packet = reader.next()) {
        sum += parseSip(*packet)->heading;
      }
    }
    benchmark::DoNotOptimize(sum);
  }
  countPackets(state, kCount);
}
BENCHMARK(BM_InformationPackets);

/** The other way: what a simulated robot sends. */
void BM_WriteInformationPackets(benchmark::State &state)
{
  const ArcosSip sip = fullSip();
  for (auto _ : state) {
    benchmark::DoNotOptimize(frameArcos(encodeSip(sip)).data());
  }
  countPackets(state, 1);
}
BENCHMARK(BM_WriteInformationPackets);

/** What a control tick asks of the driver, over a socket: a velocity and the newest state. */
void BM_DriverTick(benchmark::State &state)
{
  Line line = tcpLine();
  FakePioneer robot(line.device, "p3at");
  PioneerBase base(std::move(line.driver), {});
  double speed = 0.0;
  for (auto _ : state) {
    speed = speed > 0.2 ? 0.1 : speed + 0.00037;
    base.drive({speed, speed});
    benchmark::DoNotOptimize(base.state().odometry.x);
    robot.forget();
  }
}
BENCHMARK(BM_DriverTick)->Unit(benchmark::kMicrosecond)->UseRealTime();

/** Scans of a LMS-200, 181 readings, to ranges. */
void BM_SickScans(benchmark::State &state)
{
  const Bytes frame =
      frameSick(encodeSickScan({0.001, true, std::vector<std::uint16_t>(181, 2345), 0x10}));
  SickReader reader;
  for (auto _ : state) {
    reader.push(frame);
    while (const auto telegram = reader.next()) {
      benchmark::DoNotOptimize(sickRanges(*parseSickScan(*telegram), 1, kPi, Time{}).ranges.data());
    }
  }
  countPackets(state, 1);
}
BENCHMARK(BM_SickScans);

} // namespace
} // namespace homeward
