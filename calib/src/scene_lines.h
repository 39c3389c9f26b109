// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "edge_chains.h"

#include <homeward/calib/mirror_circles.h>

#include <vector>

namespace homeward
{

/** A mirror camera by what its rim shows. */
struct MirrorShape
{
  MirrorCircles mirror; ///< the outer centre is the principal point
  double xi = 1.0;
  double rimElevation = 0.0; ///< radians

  UnifiedCamera camera(const cv::Size &size) const;
};

/** Edges of a scene that are straight there, most of them. */
class SceneLines
{
public:
  SceneLines(const std::vector<cv::Mat1b> &pictures, const MirrorCircles &mirror);

  /** Chains of edges that are long enough to bend. */
  int count() const { return static_cast<int>(m_chains.size()); }

  struct Fit
  {
    MirrorShape shape;
    int lines = 0;        ///< that lie on great circles
    double rms = 0.0;     ///< of these, pixels
    bool tellsXi = false; ///< another xi would explain clearly fewer
  };

  /** The shape that makes great circles of the most edges; what is not free keeps its value. */
  Fit fit(const MirrorShape &start, bool freeXi, bool freeRim) const;

private:
  double cost(const MirrorShape &shape, const std::vector<EdgeChain> &chains) const;
  std::vector<EdgeChain> straightPieces(const MirrorShape &shape) const;
  MirrorShape refine(MirrorShape shape, const std::vector<EdgeChain> &chains, bool freeXi,
                     bool freeRim) const;

  /** The shape with the rim's elevation that fits best. */
  MirrorShape bestRim(MirrorShape shape) const;
  bool tellsXi(const MirrorShape &shape, bool freeRim) const;

  cv::Size m_size;
  Circle m_rim;
  int m_shortest; ///< pixels of a chain
  std::vector<EdgeChain> m_chains;
};

} // namespace homeward
