// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/id.h>
#include <homeward/place/signature.h>

#include <vector>

namespace homeward
{

/** A known place and how unlike it is. */
struct Match
{
  NodeId node;
  double dissimilarity = 0.0; ///< per pixel, see homeward::dissimilarity()
};

/** Which known place is this? All signatures in memory, compared one by one. */
class PlaceIndex
{
public:
  explicit PlaceIndex(SignatureKind kind) : m_kind(kind) {}

  /** @throw LogicError when the node is known, or the signature is of another kind or size */
  void add(NodeId node, Signature signature);

  /** @throw LogicError when the node is unknown */
  void remove(NodeId node);

  /** The `count` most similar places (fewer when fewer are known), best first; ties by id. */
  std::vector<Match> nearest(const Signature &query, std::size_t count) const;

  /** All places nearer than `limit`, best first; ties by id. */
  std::vector<Match> within(const Signature &query, double limit) const;

  SignatureKind kind() const { return m_kind; }
  std::size_t size() const { return m_nodes.size(); }
  bool contains(NodeId node) const;

private:
  std::vector<Match> all(const Signature &query) const;

  SignatureKind m_kind;
  std::vector<NodeId> m_nodes;
  std::vector<Signature> m_signatures;
};

} // namespace homeward
