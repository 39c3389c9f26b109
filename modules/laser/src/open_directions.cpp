// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/laser/open_directions.h>

#include <homeward/core/error.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace homeward
{
namespace
{

[[noreturn]] void refuse(const char *name, double value, const char *rule)
{
  throw LogicError(std::string("open directions: ") + name + " is " + std::to_string(value) +
                   ", must be " + rule);
}

void check(const OpenDirectionOptions &o)
{
  const auto atLeastZero = [](const char *name, double value) {
    if (!(value >= 0.0) || !std::isfinite(value)) {
      refuse(name, value, "0 or more");
    }
  };
  atLeastZero("nearBound", o.nearBound);
  atLeastZero("bridgedGap", o.bridgedGap);
  atLeastZero("footprintWidth", o.footprintWidth);
  atLeastZero("openRangeCap", o.openRangeCap);
  atLeastZero("widestSegment", o.widestSegment);
  if (o.farBound != 0.0 && !(o.farBound > o.nearBound)) {
    refuse("farBound", o.farBound, "0 or above nearBound");
  }
  if (!(o.openShare > 0.0 && o.openShare <= 1.0)) {
    refuse("openShare", o.openShare, "above 0 and up to 1");
  }
  if (!(o.stoppingRange > 0.0)) {
    refuse("stoppingRange", o.stoppingRange, "above 0");
  }
  if (o.count == 0) {
    refuse("count", 0.0, "1 or more");
  }
}

void check(const Scan &scan)
{
  constexpr double kSlack = 1e-6;
  if (!(scan.angleStep > 0.0) || !(scan.rangeMax > 0.0)) {
    throw LogicError("open directions: the scan's step of " + std::to_string(scan.angleStep) +
                     " rad and maximum of " + std::to_string(scan.rangeMax) + " m must be above 0");
  }
  if (static_cast<double>(scan.ranges.size()) * scan.angleStep >
      2.0 * kPi + scan.angleStep + kSlack) {
    throw LogicError("open directions: a scan of " + std::to_string(scan.ranges.size()) +
                     " readings sees more than a full turn");
  }
}

/** Ranges of the kept readings in metres, far and open ones at the bound; NaN where dropped. */
std::vector<double> keep(const Scan &scan, const OpenDirectionOptions &options)
{
  constexpr double kFull = 0.95;
  const bool bounded = options.farBound > 0.0;
  const double top = bounded ? std::min(options.farBound, scan.rangeMax) : scan.rangeMax;
  const double open = bounded ? scan.rangeMax : kFull * scan.rangeMax;
  std::vector<double> kept;
  kept.reserve(scan.ranges.size());
  for (const float reading : scan.ranges) {
    const double range = reading;
    if (range >= open) {
      kept.push_back(top);
    }
    else {
      kept.push_back(range >= options.nearBound && range <= top ? range : kUnknownRange);
    }
  }
  return kept;
}

/** Readings first .. first + count - 1, counted round. */
struct Segment
{
  std::size_t first;
  std::size_t count;
};

/** Runs of open readings, starting the round at `start`. */
std::vector<Segment> runs(const std::vector<double> &kept, double threshold, std::size_t start,
                          std::size_t bridged)
{
  std::vector<Segment> found;
  std::size_t gap = 0;
  bool going = false;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const double range = kept[(start + k) % kept.size()];
    if (std::isnan(range)) {
      going = going && ++gap <= bridged;
    }
    else if (range < threshold) {
      going = false;
    }
    else if (going) {
      found.back().count = start + k - found.back().first + 1;
      gap = 0;
    }
    else {
      found.push_back({start + k, 1});
      going = true;
      gap = 0;
    }
  }
  return found;
}

std::vector<Segment> segments(const Scan &scan, const std::vector<double> &kept, double threshold,
                              const OpenDirectionOptions &options)
{
  constexpr double kSlack = 1e-6;
  const auto bridged = static_cast<std::size_t>(options.bridgedGap / scan.angleStep + kSlack);
  const double seen = static_cast<double>(kept.size()) * scan.angleStep;
  if (seen < 2.0 * kPi - scan.angleStep / 2.0) {
    return runs(kept, threshold, 0, bridged);
  }
  // The scan closes: start the round behind something that ends a run, where there is any.
  std::size_t gap = 0;
  for (std::size_t i = 0; i < 2 * kept.size(); ++i) {
    const double range = kept[i % kept.size()];
    gap = std::isnan(range) ? gap + 1 : 0;
    if (range < threshold || gap > bridged) {
      return runs(kept, threshold, (i + 1) % kept.size(), bridged);
    }
  }
  return runs(kept, threshold, 0, bridged);
}

double median(const std::vector<double> &kept, const Segment &segment)
{
  std::vector<double> ranges;
  for (std::size_t i = segment.first; i < segment.first + segment.count; ++i) {
    const double range = kept[i % kept.size()];
    if (!std::isnan(range)) {
      ranges.push_back(range);
    }
  }
  const auto middle = ranges.begin() + static_cast<std::ptrdiff_t>(ranges.size() / 2);
  std::nth_element(ranges.begin(), middle, ranges.end());
  return *middle;
}

/** The robot passes where the segment, at the range where it stops, is wider than itself. */
bool passable(double width, const OpenDirectionOptions &options)
{
  return width >= kPi ||
         2.0 * options.stoppingRange * std::sin(width / 2.0) > options.footprintWidth;
}

} // namespace

std::vector<OpenDirection> findOpenDirections(const Scan &robotScan360,
                                              const OpenDirectionOptions &options)
{
  check(options);
  check(robotScan360);
  std::vector<double> kept = keep(robotScan360, options);
  if (static_cast<double>(kept.size()) * robotScan360.angleStep >
      2.0 * kPi + robotScan360.angleStep / 2.0) {
    kept.pop_back(); // the last reading repeats the angle of the first
  }
  double largest = 0.0;
  for (const double range : kept) {
    largest = std::isnan(range) ? largest : std::max(largest, range);
  }
  if (largest == 0.0) {
    return {};
  }
  double threshold = options.openShare * largest;
  if (options.openRangeCap > 0.0) {
    threshold = std::min(threshold, options.openRangeCap);
  }
  std::vector<OpenDirection> found;
  for (const Segment &segment : segments(robotScan360, kept, threshold, options)) {
    const double width = static_cast<double>(segment.count - 1) * robotScan360.angleStep;
    if (!passable(width, options)) {
      continue;
    }
    const double start = robotScan360.angle(segment.first);
    const double range = median(kept, segment);
    const int parts = options.widestSegment > 0.0 && width > options.widestSegment
                          ? static_cast<int>(std::ceil(width / options.widestSegment - 1e-9))
                          : 1;
    const double length = width / parts;
    for (int part = 0; part < parts; ++part) {
      found.push_back({wrapAngle(start + part * length + length / 2.0), length, range});
    }
  }
  std::sort(found.begin(), found.end(), [](const OpenDirection &a, const OpenDirection &b) {
    return a.width != b.width ? a.width > b.width : a.bearing < b.bearing;
  });
  found.resize(std::min(found.size(), options.count));
  return found;
}

} // namespace homeward
