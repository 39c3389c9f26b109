// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/place/place_index.h>

#include <homeward/core/error.h>

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>

namespace homeward
{

void PlaceIndex::add(NodeId node, Signature signature)
{
  if (contains(node)) {
    throw LogicError("node " + std::to_string(node.value) + " is in the index already");
  }
  if (signature.kind != m_kind) {
    throw LogicError("index of " + std::string(name(m_kind)) + " signatures cannot take " +
                     std::string(name(signature.kind)));
  }
  if (!m_signatures.empty()) {
    static_cast<void>(dissimilarity(signature, m_signatures.front())); // refuses other sizes
  }
  m_nodes.push_back(node);
  m_signatures.push_back(std::move(signature));
}

void PlaceIndex::remove(NodeId node)
{
  const auto found = std::find(m_nodes.begin(), m_nodes.end(), node);
  if (found == m_nodes.end()) {
    throw LogicError("node " + std::to_string(node.value) + " is not in the index");
  }
  m_signatures.erase(m_signatures.begin() + (found - m_nodes.begin()));
  m_nodes.erase(found);
}

bool PlaceIndex::contains(NodeId node) const
{
  return std::find(m_nodes.begin(), m_nodes.end(), node) != m_nodes.end();
}

std::vector<Match> PlaceIndex::all(const Signature &query) const
{
  std::vector<Match> matches;
  matches.reserve(m_nodes.size());
  for (std::size_t i = 0; i < m_nodes.size(); ++i) {
    matches.push_back({m_nodes[i], dissimilarity(query, m_signatures[i])});
  }
  std::sort(matches.begin(), matches.end(), [](const Match &a, const Match &b) {
    return std::tie(a.dissimilarity, a.node) < std::tie(b.dissimilarity, b.node);
  });
  return matches;
}

std::vector<Match> PlaceIndex::nearest(const Signature &query, std::size_t count) const
{
  std::vector<Match> matches = all(query);
  matches.resize(std::min(matches.size(), count));
  return matches;
}

std::vector<Match> PlaceIndex::within(const Signature &query, double limit) const
{
  std::vector<Match> matches = all(query);
  const auto end = std::find_if(matches.begin(), matches.end(),
                                [&](const Match &match) { return !(match.dissimilarity < limit); });
  matches.erase(end, matches.end());
  return matches;
}

} // namespace homeward
