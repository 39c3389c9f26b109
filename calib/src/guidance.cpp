// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/calib/guidance.h>

#include <homeward/core/angle.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace homeward
{
namespace
{

constexpr int kSectors = 8;
constexpr std::size_t kEnoughViews = 12;

/** Where a sector lies as the picture is displayed. */
constexpr std::array<const char *, kSectors> kSides{
    "on the right", "at the lower right", "at the bottom", "at the lower left",
    "on the left",  "at the upper left",  "at the top",    "at the upper right"};

/** What of the mirror the views cover. */
struct Coverage
{
  std::array<int, kSectors> sectors{}; ///< views whose middle lies there
  bool rim = false;                    ///< a point in the outer tenth
  bool inside = false;                 ///< a point near the inner circle
  bool large = false;                  ///< a board that fills a good part of the ring
  double slants = 0.0;                 ///< spread of how much nearer one end is than the other
};

Eigen::Vector2d middleOf(const BoardView &view)
{
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d &pixel : view.pixels) {
    sum += pixel;
  }
  return sum / static_cast<double>(view.pixels.size());
}

/**
 * How unevenly the board's points are spread, as the skewness of their pixels about their middle
 * minus that of the board itself: 0 for a board seen straight on.
 */
Eigen::Vector2d slantOf(const BoardView &view)
{
  const Eigen::Vector2d middle = middleOf(view);
  Eigen::Vector3d boardMiddle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d &point : view.board) {
    boardMiddle += point / static_cast<double>(view.board.size());
  }
  // Pixels a metre on either side of the board's middle, along its x and y.
  Eigen::Vector2d near = Eigen::Vector2d::Zero();
  Eigen::Vector2d far = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < view.pixels.size(); ++i) {
    const double spread = (view.pixels[i] - middle).norm();
    for (int axis = 0; axis < 2; ++axis) {
      (view.board[i][axis] < boardMiddle[axis] ? near : far)[axis] += spread;
    }
  }
  const auto share = [](double a, double b) { return a + b > 0.0 ? (a - b) / (a + b) : 0.0; };
  return {share(near.x(), far.x()), share(near.y(), far.y())};
}

Coverage coverageOf(const BoardViews &views, const MirrorCircles &mirror)
{
  Coverage coverage;
  const double ring = mirror.outer.radius - mirror.inner.radius;
  std::array<double, 4> extremes{0.0, 0.0, 0.0, 0.0};
  for (const BoardView &view : views.views) {
    if (view.pixels.empty()) {
      continue;
    }
    const Eigen::Vector2d out = middleOf(view) - mirror.outer.centre;
    const double turn = wrapAngle(std::atan2(out.y(), out.x()) + kPi / kSectors);
    const int sector = static_cast<int>(std::floor(turn / (2.0 * kPi / kSectors)));
    ++coverage.sectors[static_cast<std::size_t>((sector + kSectors) % kSectors)];
    double size = 0.0;
    for (const Eigen::Vector2d &pixel : view.pixels) {
      const double radius = (pixel - mirror.outer.centre).norm();
      coverage.rim = coverage.rim || radius > mirror.outer.radius - 0.12 * ring;
      coverage.inside = coverage.inside || radius < mirror.inner.radius + 0.3 * ring;
      size = std::max(size, 2.0 * (pixel - middleOf(view)).norm());
    }
    coverage.large = coverage.large || size > 0.5 * ring;
    const Eigen::Vector2d slant = slantOf(view);
    extremes = {std::min(extremes[0], slant.x()), std::max(extremes[1], slant.x()),
                std::min(extremes[2], slant.y()), std::max(extremes[3], slant.y())};
  }
  coverage.slants = std::max(extremes[1] - extremes[0], extremes[3] - extremes[2]);
  return coverage;
}

} // namespace

Guidance guide(const BoardViews &views, const MirrorCircles &mirror)
{
  if (views.views.empty()) {
    return {"Hold the board where the mirror sees all of it.", false};
  }
  const Coverage coverage = coverageOf(views, mirror);
  const auto least = std::min_element(coverage.sectors.begin(), coverage.sectors.end());
  if (views.views.size() >= 2 && !coverage.large) {
    return {"Bring the board nearer, until it fills half of the ring.", false};
  }
  if (views.views.size() >= 3 && !coverage.rim) {
    return {"Raise the board towards the rim of the mirror.", false};
  }
  if (views.views.size() >= 4 && !coverage.inside) {
    return {"Lower the board towards the middle of the picture.", false};
  }
  if (views.views.size() >= 5 && coverage.slants < 0.12) {
    return {"Tilt the board towards the rim, one edge nearer to the mirror than the other.", false};
  }
  if (*least == 0) {
    return {std::string("Carry the board on round the mirror: none yet ") +
                kSides[static_cast<std::size_t>(least - coverage.sectors.begin())] +
                " of the picture.",
            false};
  }
  if (views.views.size() < kEnoughViews) {
    return {"Good; " + std::to_string(kEnoughViews - views.views.size()) +
                " more views, tilted and turned differently.",
            false};
  }
  return {"Enough: the views cover the mirror.", true};
}

} // namespace homeward
