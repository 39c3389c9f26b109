// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/error.h>
#include <homeward/mission/report.h>
#include <homeward/topology/map.h>

#include <optional>
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

/** "Path planning 0 - 1 - 8 -". */
std::string routeLine(const std::string &state, const std::vector<NodeId> &path);

/** The verified match, else the likeliest with a probability above one half; nothing when unsure.
 */
std::optional<NodeId> likeliestPlace(const std::vector<PlaceMatch> &matches);

} // namespace homeward
