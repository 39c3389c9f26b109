// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "row_distance.h"

#include <homeward/place/signature.h>

#include <new>
#include <vector>

namespace homeward
{

/** Memory that rows may lie in. */
template <class T> struct RowAllocator
{
  using value_type = T; // NOLINT(readability-identifier-naming): the standard's name

  RowAllocator() = default;
  template <class U> explicit RowAllocator(const RowAllocator<U> & /*other*/) {}

  T *allocate(std::size_t count)
  {
    return static_cast<T *>(::operator new (count * sizeof(T), std::align_val_t{kRowAlignment}));
  }
  void deallocate(T *memory, std::size_t /*count*/)
  {
    ::operator delete (memory, std::align_val_t{kRowAlignment});
  }
  friend bool operator==(const RowAllocator & /*a*/, const RowAllocator & /*b*/) { return true; }
};

using Row = std::vector<std::byte, RowAllocator<std::byte>>;

/** Signatures of one kind and size, prepared for rowDistances(). */
class RowTable
{
public:
  explicit RowTable(SignatureKind kind);

  /**
   * A signature as a row, for add() and as a query.
   * @throw LogicError when a value is negative or not finite (a byte: no whole number to 255), or
   * the signature is of another kind, or of another size than those in the table
   */
  Row prepare(const Signature &signature) const;

  /** Appends the row prepared from a signature. */
  void append(const Signature &signature, const Row &row);

  /** Puts the last row in the place of this one. */
  void removeRow(std::size_t index);

  void reserve(std::size_t count);

  RowBlock rows(std::size_t begin, std::size_t end) const;

  /** What rowDistances() gave, as dissimilarity() says it. */
  double dissimilarityOf(float distance) const;

  SignatureKind kind() const { return m_kind; }
  RowMetric metric() const { return m_metric; }
  std::size_t rowBytes() const { return m_rowBytes; }

private:
  SignatureKind m_kind;
  RowMetric m_metric;
  int m_pixels = 0;
  std::size_t m_size = 0;     ///< values in a signature; 0 as long as none was added
  std::size_t m_rowBytes = 0; ///< likewise
  double m_unit = 1.0;
  std::size_t m_reserved = 0; ///< rows to make room for with the first
  Row m_bytes;
};

} // namespace homeward
