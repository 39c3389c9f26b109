// SPDX-License-Identifier: GPL-3.0-or-later
#include "mission_words.h"

#include <algorithm>
#include <cstdio>
#include <iterator>

namespace homeward
{

std::string explorationLine(const std::string &state, NodeId from, NodeId to,
                            std::optional<double> dissimilarity)
{
  std::string value = "-";
  if (dissimilarity) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f", *dissimilarity);
    value = text;
  }
  return state + " " + std::to_string(from.value) + " - " + std::to_string(to.value) + " " + value;
}

EdgeTried tried(EdgeId edge, const Homed &report)
{
  const std::string end = report.end == HomingEnd::Arrived ? "" : name(report.end);
  return {edge, end, report.seconds, report.time};
}

std::string routeLine(const std::string &state, const std::vector<NodeId> &path)
{
  std::string line = state + " ";
  for (std::size_t i = 0; i < path.size(); ++i) {
    line += (i == 0 ? "" : " - ") + std::to_string(path[i].value);
  }
  return line + " -";
}

std::optional<NodeId> likeliestPlace(const std::vector<PlaceMatch> &matches)
{
  constexpr double kSureEnough = 0.5;
  const auto verified = std::find_if(matches.begin(), matches.end(),
                                     [](const PlaceMatch &match) { return match.verified; });
  if (verified != matches.end()) {
    return verified->node;
  }
  const auto likeliest =
      std::max_element(matches.begin(), matches.end(),
                       [](const auto &a, const auto &b) { return a.probability < b.probability; });
  if (likeliest != matches.end() && likeliest->probability > kSureEnough) {
    return likeliest->node;
  }
  return std::nullopt;
}

std::vector<PlaceMatch> notInVain(const std::vector<PlaceMatch> &matches,
                                  const std::map<NodeId, int> &vain, int limit)
{
  std::vector<PlaceMatch> left;
  std::copy_if(matches.begin(), matches.end(), std::back_inserter(left),
               [&](const PlaceMatch &match) {
                 const auto count = vain.find(match.node);
                 return count == vain.end() || count->second < limit;
               });
  return likeliestPlace(left) ? left : matches;
}

} // namespace homeward
