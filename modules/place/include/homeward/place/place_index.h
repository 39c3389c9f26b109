// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/id.h>
#include <homeward/place/signature.h>

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace homeward
{

/** A known place and how unlike it is. */
struct Match
{
  NodeId node;                ///< the known place
  double dissimilarity = 0.0; ///< see homeward::dissimilarity()
};

/** How PlaceIndex computes. */
struct PlaceIndexOptions
{
  int threads = 1;        ///< at least 1; the answers do not depend on it
  bool vectorised = true; ///< false: plain C++ in double precision, to test against
};

/**
 * Which known place is this? Exhaustive and exact: every signature is compared, with the relative
 * error of single precision (Jeffrey: 1e-4).
 *
 * Signatures lie one after the other in one block of memory, ready to be compared; see
 * bytesPerNode().
 */
class PlaceIndex
{
public:
  /** @throw LogicError unless threads >= 1 */
  explicit PlaceIndex(SignatureKind kind, const PlaceIndexOptions &options = {});
  ~PlaceIndex();
  PlaceIndex(PlaceIndex &&) noexcept;
  PlaceIndex &operator=(PlaceIndex &&) noexcept;

  /**
   * @throw LogicError when the node is known, a value is not what its kind has, or the signature
   * is of another kind or size
   */
  void add(NodeId node, const Signature &signature);

  /** @throw LogicError when the node is unknown */
  void remove(NodeId node);

  /** Makes room, so that adding up to `count` nodes moves nothing. */
  void reserve(std::size_t count);

  /**
   * The `count` most similar places (fewer when fewer are known), best first; ties by id.
   * @throw LogicError when the query is of another kind or size; so do all queries
   */
  std::vector<Match> nearest(const Signature &query, std::size_t count) const;

  /** nearest() of many queries in one pass over the memory. */
  std::vector<std::vector<Match>> nearest(std::span<const Signature> queries,
                                          std::size_t count) const;

  /** All places nearer than `limit`, best first; ties by id. */
  std::vector<Match> within(const Signature &query, double limit) const;

  /** Of the signatures that it takes. */
  SignatureKind kind() const;
  /** Number of places that it knows. */
  std::size_t size() const;
  /** Whether it knows the place. */
  bool contains(NodeId node) const;

  /** Memory that a node takes in the block, 0 before the first. */
  std::size_t bytesPerNode() const;

private:
  class Impl;
  std::unique_ptr<Impl> m_impl;
};

} // namespace homeward
