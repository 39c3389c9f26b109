// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/pose2.h>
#include <homeward/topology/map.h>

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <vector>

namespace homeward
{

/** Where a node stands by the ways that were driven. */
struct Reckoned
{
  Pose2 fromMto;      ///< metres; heading as stored with the nodes
  double sigma = 0.0; ///< metres, one sigma along the worse axis, by the errors of the ways
};

/**
 * Where all nodes stand, seen from one: the poses that agree best with the lengths and bearings of
 * all edges together. Edges that lack one are not used.
 *
 * Least squares over the pose graph, with Huber's weights, so that one wrong edge bends little.
 * Gauss-Newton from the shortest chains; a sparse factorisation, built once for all nodes.
 */
class Reckoning
{
public:
  /** @throw LogicError for an unknown node */
  Reckoning(const TopologicalMap &map, NodeId from);
  ~Reckoning();
  Reckoning(Reckoning &&other) noexcept;
  Reckoning &operator=(Reckoning &&other) noexcept;

  /** Nothing when no such edges lead there. */
  std::optional<Reckoned> find(NodeId to) const;

  /**
   * Whoever stands near a point, the node that all is seen from among them; in order of their
   * numbers. Errors count for nothing here, as each takes a solution of the equations.
   * @param point metres, in the frame of the node that all is seen from
   */
  std::vector<NodeId> near(const Eigen::Vector2d &point, double metres) const;

private:
  class Impl;
  std::unique_ptr<const Impl> m_impl;
};

} // namespace homeward
