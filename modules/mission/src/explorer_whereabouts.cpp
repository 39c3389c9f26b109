// SPDX-License-Identifier: GPL-3.0-or-later
#include "explorer_whereabouts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace homeward
{
namespace
{

Eigen::Vector2d polar(double distance, double bearing)
{
  return {distance * std::cos(bearing), distance * std::sin(bearing)};
}

} // namespace

bool ExplorerWhereabouts::isWay(const Chord &chord) const
{
  const bool near =
      chord.distance <= m_options.nearEdge() && chord.travelled <= m_options.longestDetour();
  return chord.travelled <= m_options.longestEdge() || near;
}

const Reckoning &ExplorerWhereabouts::reckoning(NodeId from) const
{
  // Of what a step changes, edges alone count.
  const std::size_t edges = m_map.edges().size();
  if (!m_reckoning || m_reckonedFrom != from || m_reckonedEdges != edges) {
    m_reckoning.emplace(m_map, from);
    m_reckonedFrom = from;
    m_reckonedEdges = edges;
  }
  return *m_reckoning;
}

std::optional<Reckoned> ExplorerWhereabouts::reckoned(NodeId node) const
{
  return m_state.origin ? reckoning(*m_state.origin).find(node) : std::nullopt;
}

std::optional<ExplorerWhereabouts::Offset> ExplorerWhereabouts::offset(NodeId node) const
{
  const auto there = reckoned(node);
  return there ? std::optional(Offset{(there->fromMto.translation() -
                                       polar(m_state.chord.distance, m_state.chord.bearingAtOrigin))
                                          .norm(),
                                      there->sigma})
               : std::nullopt;
}

bool ExplorerWhereabouts::plausible(NodeId node, double reach) const
{
  const auto off = offset(node);
  return !off || off->distance <= reach + 2.0 * off->error;
}

/** Logarithm of the odds that the robot is at the place, by sight and by the ways driven. */
double ExplorerWhereabouts::logOdds(const PlaceMatch &match) const
{
  constexpr double kSurest = 0.99; // views are not surer, however alike
  const double probability = std::min(match.probability, kSurest);
  const double sight = std::log(probability / (1.0 - probability));
  const auto off = offset(match.node);
  const double sigmas = off ? off->distance / (m_options.placeSigma + off->error) : 0.0;
  return sigmas > m_options.farthest ? -std::numeric_limits<double>::infinity()
                                     : sight - 0.5 * sigmas * sigmas;
}

/** Whether the node stands right here by ways that are short enough to tell. */
bool ExplorerWhereabouts::standsHere(NodeId node) const
{
  const auto off = offset(node);
  return off && off->error <= m_options.surelyBeyond && off->distance <= m_options.rightHere;
}

const PlaceMatch *ExplorerWhereabouts::placeHere(const std::vector<PlaceMatch> &matches,
                                                 bool near) const
{
  const PlaceMatch *best = nullptr;
  double highest = near ? m_options.leastNear : m_options.leastLogOdds;
  for (const PlaceMatch &match : matches) {
    const double odds = logOdds(match);
    if (odds > highest && !tooOftenInVain(match.node) && !onlyLooksLike(match.node) &&
        (!near || (match.node != m_state.origin && standsHere(match.node)))) {
      highest = odds;
      best = &match;
    }
  }
  return best;
}

std::optional<NodeId> ExplorerWhereabouts::crowding() const
{
  std::optional<NodeId> nearest;
  if (!m_state.origin) {
    return nearest;
  }
  double least = m_options.crowded();
  for (const NodeId node :
       reckoning(*m_state.origin)
           .near(polar(m_state.chord.distance, m_state.chord.bearingAtOrigin), least)) {
    const auto off = offset(node);
    if (off && off->error <= m_options.surelyBeyond && off->distance < least) {
      least = off->distance;
      nearest = node;
    }
  }
  return nearest;
}

std::optional<NodeId> ExplorerWhereabouts::outOfReach(const std::vector<PlaceMatch> &matches) const
{
  const auto match = std::find_if(matches.begin(), matches.end(), [&](const PlaceMatch &seen) {
    return seen.verified && seen.node != m_state.origin && tooOftenInVain(seen.node) &&
           !onlyLooksLike(seen.node) && plausible(seen.node, m_options.crowded());
  });
  return match != matches.end() ? std::optional(match->node) : std::nullopt;
}

bool ExplorerWhereabouts::onlyLooksLike(NodeId node) const
{
  if (!m_state.origin || m_state.chord.distance > m_options.rightHere) {
    return false;
  }
  const std::pair pair{*m_state.origin, node};
  return std::find(m_state.alike.begin(), m_state.alike.end(), pair) != m_state.alike.end();
}

bool ExplorerWhereabouts::isElsewhere(NodeId node, const Chord &chord) const
{
  return m_state.origin && *m_state.origin != node && chord.distance < m_options.samePlace;
}

bool ExplorerWhereabouts::tooOftenInVain(NodeId node) const
{
  const auto count = m_state.vain.find(node);
  return count != m_state.vain.end() && count->second > 1;
}

std::optional<NodeId> ExplorerWhereabouts::nodeWhere(NodeId node, double bearing) const
{
  const Reckoning &ways = reckoning(node);
  for (const NodeId other :
       ways.near(polar(m_options.forwardDistance, bearing), m_options.closeNear)) {
    if (other != node && ways.find(other)->sigma < m_options.surelyBeyond) {
      return other;
    }
  }
  return std::nullopt;
}

} // namespace homeward
