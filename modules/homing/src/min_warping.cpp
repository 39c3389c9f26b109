// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/homing/min_warping.h>

#include "column_minimum.h"
#include "parabola.h"
#include "scale_planes.h"
#include "shift_windows.h"

#include <homeward/core/error.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

namespace homeward
{

namespace
{

/** Columns with less texture than this share carry no answer. */
constexpr double kLeastTexturedShare = 0.1;

/** Smallest distance proxy given; below it, noise decides. */
constexpr double kLeastProxy = 0.005;

/** WarpingMatch::contrast of a match beyond doubt, and of pictures of different places. */
constexpr double kSureContrast = 0.70;
constexpr double kBlindContrast = 0.965;

/** WarpingMatch::oppositeRatio of a direction beyond doubt, ... */
constexpr double kSureOpposite = 0.94;
/** ... which says nothing nearer home than the first of these distance proxies, all beyond the
 * second. */
constexpr double kNearProxy = 0.3;
constexpr double kFarProxy = 0.5;

/** Falls from 1 at `good` to 0 at `bad`. */
double ramp(double value, double good, double bad)
{
  return std::clamp((bad - value) / (bad - good), 0.0, 1.0);
}

/** At home every direction fits; elsewhere one that fits no better than its opposite is a guess. */
double confidenceOf(const WarpingMatch &match)
{
  const double near = ramp(match.home.distanceProxy, kNearProxy, kFarProxy);
  const double direction = ramp(match.oppositeRatio, kSureOpposite, 1.0);
  return std::sqrt(ramp(match.contrast, kSureContrast, kBlindContrast)) *
         (near + (1.0 - near) * direction);
}

} // namespace

/** M(alpha, psi) on the grid of search steps. */
class MinWarping::Sums
{
public:
  static constexpr std::int32_t kUnsearched = std::numeric_limits<std::int32_t>::max();

  /** @param turns which heading changes, in steps, are searched */
  explicit Sums(const std::vector<bool> &turns) : m_steps(turns.size())
  {
    m_values.assign(m_steps * m_steps, kUnsearched);
    for (std::size_t turn = 0; turn < m_steps; ++turn) {
      if (turns[turn]) {
        std::fill_n(&m_values[turn * m_steps], m_steps, 0);
      }
    }
  }

  int steps() const { return static_cast<int>(m_steps); }
  std::int32_t *turn(std::size_t psi) { return &m_values[psi * m_steps]; }
  const std::vector<std::int32_t> &values() const { return m_values; }

  /** Any integers, in steps. */
  std::int32_t at(int psi, int alpha) const { return m_values[wrap(psi) * m_steps + wrap(alpha)]; }

  /** The value in 0 to steps - 1 for any integer. */
  std::size_t wrap(int step) const
  {
    return static_cast<std::size_t>(((step % steps()) + steps()) % steps());
  }

private:
  std::size_t m_steps;
  std::vector<std::int32_t> m_values;
};

/** The best grid point and the refined one. */
struct MinWarping::Minimum
{
  int psi = 0;               ///< columns
  int alpha = 0;             ///< columns
  double refinedPsi = 0.0;   ///< columns
  double refinedAlpha = 0.0; ///< columns
  std::int32_t value = Sums::kUnsearched;
};

MinWarping::MinWarping(const MinWarpingOptions &options) : m_options(options)
{
  if (options.planes < 3 || options.planes > 31 || options.planes % 2 == 0) {
    throw LogicError("planes is " + std::to_string(options.planes) +
                     ", must be odd and between 3 and 31");
  }
  if (!(options.scaleMax > 1.0) || !(options.scaleLimit >= options.scaleMax)) {
    throw LogicError("scaleMax is " + std::to_string(options.scaleMax) + " and scaleLimit " +
                     std::to_string(options.scaleLimit) + ", must be 1 < scaleMax <= scaleLimit");
  }
  if (!(options.compassShare > 0.0) || options.compassShare > 1.0) {
    throw LogicError("compassShare is " + std::to_string(options.compassShare) +
                     ", must be above 0 and at most 1");
  }
  if (options.searchStep < 1 || options.columns / 2 % options.searchStep != 0) {
    throw LogicError("searchStep is " + std::to_string(options.searchStep) +
                     ", must divide half of the " + std::to_string(options.columns) + " columns");
  }
  m_featureOptions.columns = options.columns;
  m_featureOptions.rows = options.rows;
  m_featureOptions.magnifications = options.planes / 2 + 1;
  m_featureOptions.magnificationStep = std::pow(options.scaleMax, 2.0 / (options.planes - 1));
  checkColumnFeatureOptions(m_featureOptions);
  buildTemplate();
  buildWindows();
}

void MinWarping::buildWindows()
{
  const int columns = m_options.columns;
  for (const std::vector<Candidate> &candidates : m_template) {
    std::vector<Window> &windows = m_windows.emplace_back();
    std::vector<std::pair<int, int>> sorted; // plane, delta
    sorted.reserve(candidates.size());
    for (const Candidate &candidate : candidates) {
      sorted.emplace_back(candidate.plane, candidate.delta);
    }
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t begin = 0; begin < sorted.size();) {
      std::size_t end = begin + 1;
      while (end < sorted.size() && sorted[end].first == sorted[begin].first &&
             sorted[end].second <= sorted[end - 1].second + 1) {
        ++end;
      }
      const auto [plane, first] = sorted[begin];
      const int last = sorted[end - 1].second;
      int level = ShiftWindows::kLevels - 1;
      while (1 << level > last - first + 1) {
        --level;
      }
      const int length = 1 << level;
      for (int delta = first; delta <= last; delta += length) {
        // The last window ends where the run ends, over the one before.
        const int from = std::min(delta, last - length + 1);
        windows.push_back({level * m_options.planes + plane, (from + columns) % columns});
      }
      begin = end;
    }
  }
}

void MinWarping::buildTemplate()
{
  const int columns = m_options.columns;
  const int half = columns / 2;
  const int middle = m_options.planes / 2;
  const double logStep = std::log(m_featureOptions.magnificationStep);
  m_template.assign(static_cast<std::size_t>(columns), {});
  const auto admit = [&](int x, int delta, int plane) {
    m_template[static_cast<std::size_t>(x)].push_back({delta, plane});
  };
  for (int plane = middle; plane < m_options.planes; ++plane) {
    admit(0, 0, plane);                 // ahead: only nearer
    admit(half, 0, 2 * middle - plane); // behind: only farther
  }
  for (int x = 1; x < half; ++x) {
    const double angle = 2.0 * kPi * x / columns;
    for (int delta = 0; x + delta < half; ++delta) {
      const double moved = angle + 2.0 * kPi * delta / columns;
      const double scale = std::sin(moved) / std::sin(angle);
      if (scale > m_options.scaleLimit || scale < 1.0 / m_options.scaleLimit) {
        continue;
      }
      // The planes met within half a column of delta.
      const double halfStep = kPi / columns;
      const auto planeAt = [&](double bearing) {
        const double bounded = std::clamp(bearing, angle, kPi - 1e-3);
        const double logScale = std::log(std::sin(bounded) / std::sin(angle));
        const int step = static_cast<int>(std::lround(logScale / logStep));
        return std::clamp(middle + step, 0, m_options.planes - 1);
      };
      const int one = planeAt(moved - halfStep);
      const int other = planeAt(moved + halfStep);
      for (int plane = std::min(one, other); plane <= std::max(one, other); ++plane) {
        admit(x, delta, plane);
        admit(columns - x, -delta, plane);
      }
    }
  }
}

std::vector<bool> MinWarping::likelyTurns(const ScalePlanes &forward) const
{
  const int columns = m_options.columns;
  const int steps = columns / m_options.searchStep;
  std::vector<int> cost(static_cast<std::size_t>(steps));
  for (int turn = 0; turn < steps; ++turn) {
    const std::uint8_t *row = forward.row(forward.middlePlane(), -turn * m_options.searchStep);
    cost[static_cast<std::size_t>(turn)] = std::accumulate(row, row + 2L * columns, 0);
  }
  const auto kept = static_cast<std::size_t>(
      std::clamp<long>(std::lround(m_options.compassShare * steps), 1L, steps));
  std::vector<int> order(static_cast<std::size_t>(steps));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return cost[static_cast<std::size_t>(a)] < cost[static_cast<std::size_t>(b)];
  });
  std::vector<bool> turns(static_cast<std::size_t>(steps), false);
  for (std::size_t i = 0; i < kept; ++i) {
    for (const int neighbour : {-1, 0, 1}) { // the refinement looks one step aside
      turns[static_cast<std::size_t>((order[i] + neighbour + steps) % steps)] = true;
    }
  }
  return turns;
}

void MinWarping::accumulate(const ScalePlanes &planes, const std::vector<bool> &turns, bool swapped,
                            Sums &sums) const
{
  const int columns = m_options.columns;
  const int step = m_options.searchStep;
  const auto steps = static_cast<std::size_t>(columns / step);
  const ShiftWindows windows(planes);
  std::vector<const std::uint8_t *> rows;
  std::vector<std::uint8_t> minima(steps + kVectorPadding);
  std::vector<std::uint16_t> total(steps + kVectorPadding);
  for (std::size_t turn = 0; turn < steps; ++turn) {
    if (!turns[turn]) {
      continue;
    }
    const int psi = static_cast<int>(turn) * step;
    const int turned = swapped ? psi : columns - psi;
    std::fill(total.begin(), total.end(), std::uint16_t{0});
    for (int x = 0; x < columns; ++x) {
      const std::size_t position = planes.position(x);
      const std::vector<Window> &wanted = m_windows[static_cast<std::size_t>(x)];
      rows.resize(wanted.size());
      for (std::size_t w = 0; w < wanted.size(); ++w) {
        const int shift = wanted[w].delta + turned;
        rows[w] = windows.row(wanted[w].run, shift < columns ? shift : shift - columns) + position;
      }
      addColumnMinima(rows.data(), rows.size(), steps, minima.data(), total.data());
    }
    // Seen from the other place, home lies at alpha + pi - psi.
    const int offset = swapped ? (columns / 2 - psi) / step : 0;
    std::int32_t *sum = sums.turn(turn);
    for (std::size_t alpha = 0; alpha < steps; ++alpha) {
      sum[alpha] += total[sums.wrap(static_cast<int>(alpha) + offset)];
    }
  }
}

MinWarping::Minimum MinWarping::findMinimum(const Sums &sums) const
{
  const int step = m_options.searchStep;
  const auto best = std::min_element(sums.values().begin(), sums.values().end());
  const auto index = static_cast<int>(best - sums.values().begin());
  const int psi = index / sums.steps();
  const int alpha = index % sums.steps();
  Minimum minimum;
  minimum.psi = step * psi;
  minimum.alpha = step * alpha;
  minimum.value = *best;
  const auto vertex = [&](int psiStep, int alphaStep) {
    const std::int32_t before = sums.at(psi - psiStep, alpha - alphaStep);
    const std::int32_t after = sums.at(psi + psiStep, alpha + alphaStep);
    return before == Sums::kUnsearched || after == Sums::kUnsearched
               ? 0.0
               : parabolaVertex(before, minimum.value, after);
  };
  minimum.refinedPsi = minimum.psi + step * vertex(1, 0);
  minimum.refinedAlpha = minimum.alpha + step * vertex(0, 1);
  return minimum;
}

double MinWarping::distanceProxy(const ScalePlanes &forward, const Minimum &minimum) const
{
  const int columns = m_options.columns;
  const double column = 2.0 * kPi / columns;
  const double turned = (minimum.refinedPsi - minimum.psi) * column;
  std::vector<double> relative;
  for (int x = 0; x < columns; ++x) {
    const double angle = wrapAngle(x * column);
    if (std::abs(std::sin(angle)) < 0.5) {
      continue; // nearly along the movement the bearing does not tell the distance
    }
    const std::size_t i = forward.position(forward.wrapColumn(minimum.alpha + x));
    const auto distance = [&](int plane, int delta) {
      return static_cast<int>(forward.row(plane, delta - minimum.psi)[i]);
    };
    Candidate best = m_template[static_cast<std::size_t>(x)].front();
    for (const Candidate &candidate : m_template[static_cast<std::size_t>(x)]) {
      if (distance(candidate.plane, candidate.delta) < distance(best.plane, best.delta)) {
        best = candidate;
      }
    }
    const double vertex =
        parabolaVertex(distance(best.plane, best.delta - 1), distance(best.plane, best.delta),
                       distance(best.plane, best.delta + 1));
    const double delta = (best.delta + vertex) * column + turned;
    relative.push_back(std::sin(delta) / std::sin(angle + delta));
  }
  const auto quarter = static_cast<std::ptrdiff_t>(relative.size() / 4);
  std::sort(relative.begin(), relative.end());
  const double sum = std::accumulate(relative.begin() + quarter, relative.end() - quarter, 0.0);
  const double mean = sum / static_cast<double>(std::ssize(relative) - 2 * quarter);
  return std::max(kLeastProxy, mean);
}

WarpingMatch MinWarping::describe(const ScalePlanes &forward, const Sums &sums,
                                  const Minimum &minimum) const
{
  const int steps = sums.steps();
  const int step = m_options.searchStep;
  const double column = 2.0 * kPi / m_options.columns;
  std::vector<bool> farAlpha; // by alpha - psi + steps
  for (int difference = -steps; difference < steps; ++difference) {
    const double turn = wrapAngle((difference * step - minimum.alpha + minimum.psi) * column);
    farAlpha.push_back(std::abs(turn) > radians(60.0));
  }
  std::vector<std::int32_t> searched;
  std::int32_t otherTurn = Sums::kUnsearched;
  std::int32_t opposite = Sums::kUnsearched;
  for (int psi = 0; psi < steps; ++psi) {
    const bool farTurn = std::abs(wrapAngle((psi * step - minimum.psi) * column)) > radians(20.0);
    for (int alpha = 0; alpha < steps; ++alpha) {
      const std::int32_t value = sums.at(psi, alpha);
      if (value == Sums::kUnsearched) {
        continue;
      }
      searched.push_back(value);
      otherTurn = farTurn ? std::min(otherTurn, value) : otherTurn;
      const int turn = alpha - psi + steps;
      opposite = farAlpha[static_cast<std::size_t>(turn)] ? std::min(opposite, value) : opposite;
    }
  }
  const auto middle = searched.begin() + std::ssize(searched) / 2;
  std::nth_element(searched.begin(), middle, searched.end());
  const auto ratioTo = [&](std::int32_t value) {
    return value > 0 ? static_cast<double>(minimum.value) / value : 1.0;
  };

  WarpingMatch match;
  match.contrast = ratioTo(*middle);
  match.headingRatio = ratioTo(otherTurn);
  match.oppositeRatio = ratioTo(opposite);
  match.matchDistance = minimum.value / (forward.fullSum() * (m_options.doubleSearch ? 2.0 : 1.0));
  match.home.direction = wrapAngle((minimum.refinedAlpha - minimum.refinedPsi) * column + kPi);
  match.home.headingChange = wrapAngle(minimum.refinedPsi * column);
  match.home.distanceProxy = distanceProxy(forward, minimum);
  match.home.confidence = confidenceOf(match);
  return match;
}

ColumnFeatures MinWarping::prepare(const Panorama &panorama) const
{
  return makeColumnFeatures(panorama, m_featureOptions);
}

std::optional<WarpingMatch> MinWarping::match(const ColumnFeatures &current,
                                              const ColumnFeatures &snapshot) const
{
  if (!(current.options == m_featureOptions) || !(snapshot.options == m_featureOptions)) {
    throw LogicError("panorama was prepared with other min-warping options");
  }
  if (std::min(current.texturedShare, snapshot.texturedShare) < kLeastTexturedShare) {
    return std::nullopt;
  }
  const ScalePlanes forward(snapshot, current, m_options.searchStep);
  const std::vector<bool> turns = likelyTurns(forward);
  Sums sums(turns);
  accumulate(forward, turns, false, sums);
  if (m_options.doubleSearch) {
    accumulate(forward.swapped(), turns, true, sums);
  }
  return describe(forward, sums, findMinimum(sums));
}

std::optional<HomeVector> MinWarping::compute(const Panorama &current, const Panorama &snapshot)
{
  const std::optional<WarpingMatch> found = match(prepare(current), prepare(snapshot));
  return found ? std::optional(found->home) : std::nullopt;
}

} // namespace homeward
