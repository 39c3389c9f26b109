// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/place/place_index.h>

#include "row_table.h"

#include <homeward/core/error.h>

#include <algorithm>
#include <array>
#include <string>
#include <thread>
#include <unordered_map>
#include <utility>

namespace homeward
{

namespace
{

/** Rows compared at a time: their distances stay in the cache, and so do rows for many queries. */
constexpr std::size_t kBlockRows = 128;
/** Bytes that keep a processor busy for much longer than a thread takes to start. */
constexpr std::size_t kThreadBytes = std::size_t{4} << 20U;

/** A distance as rowDistances() gives it. */
struct Candidate
{
  float distance;
  NodeId node;

  friend bool operator<(const Candidate &a, const Candidate &b)
  {
    return a.distance != b.distance ? a.distance < b.distance : a.node < b.node;
  }
};

/** The smallest candidates of those offered. */
class Smallest
{
public:
  explicit Smallest(std::size_t count) : m_count(count) {}

  void offer(const Candidate &candidate)
  {
    if (m_heap.size() == m_count) {
      if (m_heap.empty() || !(candidate < m_heap.front())) {
        return;
      }
      std::pop_heap(m_heap.begin(), m_heap.end());
      m_heap.pop_back();
    }
    m_heap.push_back(candidate);
    std::push_heap(m_heap.begin(), m_heap.end());
  }

  const std::vector<Candidate> &all() const { return m_heap; }

private:
  std::size_t m_count;
  std::vector<Candidate> m_heap; ///< the largest first
};

/** Runs work(part) for parts 0 to count - 1, each on a thread of its own. */
template <class Work> void inParallel(std::size_t count, Work work)
{
  std::vector<std::thread> threads;
  for (std::size_t part = 1; part < count; ++part) {
    threads.emplace_back([&work, part] { work(part); });
  }
  work(0);
  for (std::thread &thread : threads) {
    thread.join();
  }
}

} // namespace

class PlaceIndex::Impl
{
public:
  Impl(SignatureKind kind, const PlaceIndexOptions &options) : m_options(options), m_table(kind)
  {
    if (options.threads < 1) {
      throw LogicError("threads is " + std::to_string(options.threads) + ", must be at least 1");
    }
  }

  void add(NodeId node, const Signature &signature);
  void remove(NodeId node);
  void reserve(std::size_t count);
  std::vector<std::vector<Match>> nearest(std::span<const Signature> queries,
                                          std::size_t count) const;
  std::vector<Match> within(const Signature &query, double limit) const;

  const RowTable &table() const { return m_table; }
  std::size_t size() const { return m_nodes.size(); }
  bool contains(NodeId node) const { return m_rowOf.contains(node); }

private:
  std::vector<Row> prepare(std::span<const Signature> queries) const;
  std::size_t parts(std::size_t queries) const;

  /** Calls visit(part, query, candidate) for every query and node; parts at the same time. */
  template <class Visit>
  void compare(const std::vector<Row> &queries, std::size_t parts, Visit visit) const;

  std::vector<Match> toMatches(std::vector<Candidate> candidates) const;

  PlaceIndexOptions m_options;
  RowTable m_table;
  std::vector<NodeId> m_nodes; ///< by row
  std::unordered_map<NodeId, std::size_t> m_rowOf;
};

void PlaceIndex::Impl::add(NodeId node, const Signature &signature)
{
  if (contains(node)) {
    throw LogicError("node " + std::to_string(node.value) + " is in the index already");
  }
  m_table.append(signature, m_table.prepare(signature));
  m_rowOf.emplace(node, m_nodes.size());
  m_nodes.push_back(node);
}

void PlaceIndex::Impl::remove(NodeId node)
{
  const auto found = m_rowOf.find(node);
  if (found == m_rowOf.end()) {
    throw LogicError("node " + std::to_string(node.value) + " is not in the index");
  }
  const std::size_t row = found->second;
  m_rowOf[m_nodes.back()] = row;
  m_rowOf.erase(node);
  m_nodes[row] = m_nodes.back();
  m_nodes.pop_back();
  m_table.removeRow(row);
}

void PlaceIndex::Impl::reserve(std::size_t count)
{
  m_table.reserve(count);
  m_nodes.reserve(count);
  m_rowOf.reserve(count);
}

std::vector<Row> PlaceIndex::Impl::prepare(std::span<const Signature> queries) const
{
  std::vector<Row> rows;
  rows.reserve(queries.size());
  for (const Signature &query : queries) {
    rows.push_back(m_table.prepare(query));
  }
  return rows;
}

std::size_t PlaceIndex::Impl::parts(std::size_t queries) const
{
  const std::size_t bytes = size() * m_table.rowBytes() * queries;
  return bytes < kThreadBytes ? 1 : static_cast<std::size_t>(m_options.threads);
}

template <class Visit>
void PlaceIndex::Impl::compare(const std::vector<Row> &queries, std::size_t parts,
                               Visit visit) const
{
  const auto distances = m_options.vectorised ? rowDistances : rowDistancesScalar;
  inParallel(parts, [&](std::size_t part) {
    std::array<float, kBlockRows> values{};
    const std::size_t last = size() * (part + 1) / parts;
    for (std::size_t begin = size() * part / parts; begin < last; begin += kBlockRows) {
      const std::size_t end = std::min(last, begin + kBlockRows);
      for (std::size_t q = 0; q < queries.size(); ++q) {
        distances(m_table.metric(), queries[q].data(), m_table.rows(begin, end), values.data());
        for (std::size_t row = begin; row < end; ++row) {
          visit(part, q, Candidate{values[row - begin], m_nodes[row]});
        }
      }
    }
  });
}

std::vector<Match> PlaceIndex::Impl::toMatches(std::vector<Candidate> candidates) const
{
  std::sort(candidates.begin(), candidates.end());
  std::vector<Match> matches;
  matches.reserve(candidates.size());
  for (const Candidate &candidate : candidates) {
    matches.push_back({candidate.node, m_table.dissimilarityOf(candidate.distance)});
  }
  return matches;
}

std::vector<std::vector<Match>> PlaceIndex::Impl::nearest(std::span<const Signature> queries,
                                                          std::size_t count) const
{
  const std::size_t parts = this->parts(queries.size());
  std::vector<Smallest> best(parts * queries.size(), Smallest(std::min(count, size())));
  compare(prepare(queries), parts,
          [&](std::size_t part, std::size_t query, const Candidate &candidate) {
            best[part * queries.size() + query].offer(candidate);
          });
  std::vector<std::vector<Match>> answers;
  for (std::size_t q = 0; q < queries.size(); ++q) {
    std::vector<Candidate> candidates;
    for (std::size_t part = 0; part < parts; ++part) {
      const std::vector<Candidate> &found = best[part * queries.size() + q].all();
      candidates.insert(candidates.end(), found.begin(), found.end());
    }
    answers.push_back(toMatches(std::move(candidates)));
    answers.back().resize(std::min(answers.back().size(), count));
  }
  return answers;
}

std::vector<Match> PlaceIndex::Impl::within(const Signature &query, double limit) const
{
  const std::size_t parts = this->parts(1);
  std::vector<std::vector<Candidate>> found(parts);
  compare(prepare({&query, 1}), parts,
          [&](std::size_t part, std::size_t /*query*/, const Candidate &candidate) {
            if (m_table.dissimilarityOf(candidate.distance) < limit) {
              found[part].push_back(candidate);
            }
          });
  for (std::size_t part = 1; part < parts; ++part) {
    found[0].insert(found[0].end(), found[part].begin(), found[part].end());
  }
  return toMatches(std::move(found[0]));
}

PlaceIndex::PlaceIndex(SignatureKind kind, const PlaceIndexOptions &options)
    : m_impl(std::make_unique<Impl>(kind, options))
{}

PlaceIndex::~PlaceIndex() = default;
PlaceIndex::PlaceIndex(PlaceIndex &&) noexcept = default;
PlaceIndex &PlaceIndex::operator=(PlaceIndex &&) noexcept = default;

void PlaceIndex::add(NodeId node, const Signature &signature)
{
  m_impl->add(node, signature);
}

void PlaceIndex::remove(NodeId node)
{
  m_impl->remove(node);
}

void PlaceIndex::reserve(std::size_t count)
{
  m_impl->reserve(count);
}

std::vector<Match> PlaceIndex::nearest(const Signature &query, std::size_t count) const
{
  return m_impl->nearest({&query, 1}, count).front();
}

std::vector<std::vector<Match>> PlaceIndex::nearest(std::span<const Signature> queries,
                                                    std::size_t count) const
{
  return m_impl->nearest(queries, count);
}

std::vector<Match> PlaceIndex::within(const Signature &query, double limit) const
{
  return m_impl->within(query, limit);
}

SignatureKind PlaceIndex::kind() const
{
  return m_impl->table().kind();
}

std::size_t PlaceIndex::size() const
{
  return m_impl->size();
}

bool PlaceIndex::contains(NodeId node) const
{
  return m_impl->contains(node);
}

std::size_t PlaceIndex::bytesPerNode() const
{
  return m_impl->table().rowBytes();
}

} // namespace homeward
