// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/error.h>
#include <homeward/mission/report.h>
#include <homeward/topology/map.h>

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace homeward
{

/** The report as the kind that the phase waits for. @throw LogicError when it is another */
template <class Kind> const Kind &answer(const Report &report)
{
  const Kind *kind = std::get_if<Kind>(&report);
  if (kind == nullptr) {
    throw LogicError("report of kind " + std::to_string(report.index()) +
                     " does not answer the command that was given");
  }
  return *kind;
}

/** "Exploration(Homing) 4 - 3 218.2", or "-" in place of a missing dissimilarity. */
std::string explorationLine(const std::string &state, NodeId from, NodeId to,
                            std::optional<double> dissimilarity);

/** What a leg along an edge came to, for the edge's statistics. */
EdgeTried tried(EdgeId edge, const Homed &report);

/** "Path planning 0 - 1 - 8 -". */
std::string routeLine(const std::string &state, const std::vector<NodeId> &path);

/** The verified match, else the likeliest with a probability above one half; nothing when unsure.
 */
std::optional<NodeId> likeliestPlace(const std::vector<PlaceMatch> &matches);

/** The matches without the places homed to in vain `limit` times; all of them when none is left. */
std::vector<PlaceMatch> notInVain(const std::vector<PlaceMatch> &matches,
                                  const std::map<NodeId, int> &vain, int limit);

/**
 * The path over edges that failed seldom: those that failed twice are left out first, and allowed
 * again, failure by failure up to `tries`, when there is no path without them.
 * @param plan takes the edges not to be used, returns an optional path
 */
template <class Plan>
auto overSoundEdges(const std::map<EdgeId, int> &failures, int tries, const Plan &plan)
{
  constexpr int kFirst = 2;
  for (int limit = kFirst;; ++limit) {
    std::set<EdgeId> blocked;
    for (const auto &[edge, count] : failures) {
      if (count >= limit) {
        blocked.insert(edge);
      }
    }
    auto path = plan(blocked);
    if (path || limit >= tries) {
      return path;
    }
  }
}

} // namespace homeward
