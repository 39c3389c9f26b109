// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/mission/explorer.h>
#include <homeward/topology/reckoning.h>

#include <optional>
#include <vector>

namespace homeward
{

/** Where the robot of an exploration stands, by the ways driven and by sight. */
class ExplorerWhereabouts
{
public:
  struct Offset
  {
    double distance = 0.0; ///< metres
    double error = 0.0;    ///< of it by the ways, metres, one sigma
  };

  /** All must outlive this; it says what holds for them as they are when it is asked. */
  ExplorerWhereabouts(const ExplorerOptions &options, const TopologicalMap &map,
                      const ExplorerState &state)
      : m_options(options), m_map(map), m_state(state)
  {}

  /** Where the node stands, seen from the place left, by the ways driven. */
  std::optional<Reckoned> reckoned(NodeId node) const;

  /** How far the node lies from where the robot stands, by the ways driven. */
  std::optional<Offset> offset(NodeId node) const;

  /** Whether the node can stand within `reach` metres of the robot. */
  bool plausible(NodeId node, double reach) const;

  /**
   * The known place that the robot most probably is at; nullptr if that is not likely enough.
   * @param near only those but the origin that stand right here by the ways; sight may doubt them
   */
  const PlaceMatch *placeHere(const std::vector<PlaceMatch> &matches, bool near) const;

  /** The node too near to the robot, by ways short enough to tell, for a new one here. */
  std::optional<NodeId> crowding() const;

  /** What the view surely shows and the ways allow to be crowding, but was homed to in vain. */
  std::optional<NodeId> outOfReach(const std::vector<PlaceMatch> &matches) const;

  /** Whether the robot stands beside the place left, which is known only to look like the node. */
  bool onlyLooksLike(NodeId node) const;

  /** Whether a robot that seems to have come to the node stands where it left another. */
  bool isElsewhere(NodeId node, const Chord &chord) const;

  /** The node where a drive from `node` would end, by ways short enough to be sure of it. */
  std::optional<NodeId> nodeWhere(NodeId node, double bearing) const;

  /** Whether what was driven is short enough to stand for a way. */
  bool isWay(const Chord &chord) const;

private:
  const Reckoning &reckoning(NodeId from) const;
  double logOdds(const PlaceMatch &match) const;
  bool standsHere(NodeId node) const;
  bool tooOftenInVain(NodeId node) const;

  const ExplorerOptions &m_options;
  const TopologicalMap &m_map;
  const ExplorerState &m_state;

  // What was reckoned last, and from which node and how many edges.
  mutable std::optional<Reckoning> m_reckoning;
  mutable NodeId m_reckonedFrom;
  mutable std::size_t m_reckonedEdges = 0;
};

} // namespace homeward
