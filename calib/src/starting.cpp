// SPDX-License-Identifier: GPL-3.0-or-later
#include "starting.h"

#include "robust_fit.h"

#include <homeward/calib/convert.h>
#include <homeward/calib/radial_start.h>
#include <homeward/camera/unified_model.h>
#include <homeward/core/error.h>

#include <algorithm>
#include <cmath>

namespace homeward
{
namespace
{

BundleState stateOf(const RadialStart &start, const BoardViews &views)
{
  UnifiedCamera::Parameters p;
  p.xi = start.xi;
  p.fx = start.f;
  p.fy = start.f;
  p.cx = start.centre.x();
  p.cy = start.centre.y();
  return {std::make_shared<UnifiedModel>(UnifiedCamera(p, views.width, views.height)), start.cMo};
}

/** The start followed to its end, the scale renewed on the way. */
BundleResult followed(const BoardViews &views, BundleState state)
{
  const PointMask all = everyPoint(views.views);
  BundleOptions options;
  options.estimated = freeParameters(*state.model, false);
  options.loss = Loss::Huber;
  options.still = 1e-7;
  BundleResult result;
  for (const int iterations : {15, 15, 50}) {
    options.scale = robustScale(views.views, all, state);
    options.iterations = iterations;
    result = adjustBundle(views.views, all, state, options);
    state = result.state;
  }
  return result;
}

} // namespace

std::optional<Started> findStart(const BoardViews &views, const Eigen::Vector2d &centre,
                                 const CameraModel *given, int starts)
{
  std::vector<RadialStart> candidates = radialStarts(views, centre, starts);
  if (given != nullptr) {
    const Eigen::VectorXd p = given->parameters();
    const auto asGiven = radialStart(views, p[0], p[1], p.segment<2>(3));
    if (asGiven) {
      candidates.push_back(*asGiven);
    }
  }
  std::optional<Started> best;
  double scale = 0.0;
  const PointMask all = everyPoint(views.views);
  std::vector<BundleState> ends;
  for (const RadialStart &candidate : candidates) {
    ends.push_back(followed(views, stateOf(candidate, views)).state);
    const double here = robustScale(views.views, all, ends.back());
    scale = scale == 0.0 ? here : std::min(scale, here);
  }
  BundleOptions options;
  options.loss = Loss::Huber;
  options.scale = scale;
  options.iterations = 0;
  for (const BundleState &end : ends) {
    options.estimated = freeParameters(*end.model, false);
    const double cost = adjustBundle(views.views, all, end, options).cost;
    if (std::isfinite(cost) && (!best || cost < best->cost)) {
      best = Started{end, cost};
    }
  }
  return best;
}

} // namespace homeward
