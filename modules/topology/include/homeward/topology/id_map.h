// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/error.h>

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace homeward
{

/**
 * Values by an id that counts from 0 and is never given twice. Reads like a std::map in order of
 * ids, looks up by index; what was removed leaves a gap. Two are equal when values, gaps and the
 * next id are.
 * @tparam Key an Id of core
 */
template <class Key, class Value> class IdMap
{
public:
  /** Goes through the things in order of ids. */
  class const_iterator // NOLINT(readability-identifier-naming): the name that algorithms expect
  {
  public:
    /** As algorithms expect. */
    using iterator_category = std::input_iterator_tag;
    /** An id and what it names. */
    using value_type = std::pair<Key, const Value &>;
    /** As algorithms expect. */
    using difference_type = std::ptrdiff_t;
    /** As algorithms expect. */
    using reference = value_type;

    /** An entry that lives as long as the expression it is asked in. */
    struct pointer // NOLINT(readability-identifier-naming): as above
    {
      value_type entry; ///< an id and what it names
      const value_type *operator->() const { return &entry; }
    };

    const_iterator() = default;
    /** At the first thing from `index` on. */
    const_iterator(const IdMap &map, std::size_t index) : m_map(&map), m_index(index) { skip(); }

    reference operator*() const
    {
      return {Key{static_cast<std::int64_t>(m_index)}, *m_map->m_values[m_index]};
    }
    pointer operator->() const { return {**this}; }
    const_iterator &operator++()
    {
      ++m_index;
      skip();
      return *this;
    }
    const_iterator operator++(int)
    {
      const const_iterator before = *this;
      ++*this;
      return before;
    }
    bool operator==(const const_iterator &) const = default;

  private:
    void skip()
    {
      while (m_index < m_map->m_values.size() && !m_map->m_values[m_index]) {
        ++m_index;
      }
    }

    const IdMap *m_map = nullptr;
    std::size_t m_index = 0;
  };
  using iterator = const_iterator; ///< values change through at() alone

  const_iterator begin() const { return {*this, 0}; }
  const_iterator end() const { return {*this, m_values.size()}; }

  /** Number of things. */
  std::size_t size() const { return m_size; }
  /** Whether there is nothing. */
  bool empty() const { return m_size == 0; }

  /** The id that the next value gets. */
  Key next() const { return {static_cast<std::int64_t>(m_values.size())}; }

  /** Whether the id names something. */
  bool contains(Key id) const { return find(id) != nullptr; }

  /** Null when there is none. */
  const Value *find(Key id) const
  {
    // A negative id is a large index.
    const auto index = static_cast<std::size_t>(id.value);
    return index < m_values.size() && m_values[index] ? &*m_values[index] : nullptr;
  }

  /** @throw LogicError when there is none */
  const Value &at(Key id) const
  {
    const Value *found = find(id);
    if (found == nullptr) {
      throw LogicError("id " + std::to_string(id.value) + " is unknown");
    }
    return *found;
  }
  /** @throw LogicError when there is none */
  Value &at(Key id) { return const_cast<Value &>(std::as_const(*this).at(id)); }

  /** Adds a value at next(). */
  void add(Value value)
  {
    m_values.emplace_back(std::move(value));
    ++m_size;
  }

  /** Leaves a gap up to `next`, which then is next(). @throw LogicError when that was passed */
  void skipTo(Key next)
  {
    if (next < this->next()) {
      throw LogicError("id " + std::to_string(next.value) + " was given already");
    }
    m_values.resize(static_cast<std::size_t>(next.value));
  }

  /** Leaves a gap. @throw LogicError when there is none */
  void remove(Key id)
  {
    at(id);
    m_values[static_cast<std::size_t>(id.value)].reset();
    --m_size;
  }

  bool operator==(const IdMap &) const = default;

private:
  std::vector<std::optional<Value>> m_values; ///< by id
  std::size_t m_size = 0;                     ///< without the gaps
};

} // namespace homeward
