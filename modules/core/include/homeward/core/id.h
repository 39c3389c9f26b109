// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>

namespace homeward
{

/** A number that names one thing of one kind; ids of different kinds do not mix. Never reused. */
template <class Tag> struct Id
{
  std::int64_t value = -1; ///< -1 names nothing

  friend bool operator==(Id a, Id b) { return a.value == b.value; }
  friend bool operator!=(Id a, Id b) { return a.value != b.value; }
  friend bool operator<(Id a, Id b) { return a.value < b.value; }
};

/** Names a place of a map. */
using NodeId = Id<struct NodeTag>;
/** Names a way between two places. */
using EdgeId = Id<struct EdgeTag>;
/** Names a direction of one place. */
using DirectionId = Id<struct DirectionTag>;

} // namespace homeward

/** Ids as keys of unordered containers. */
template <class Tag> struct std::hash<homeward::Id<Tag>>
{
  std::size_t operator()(homeward::Id<Tag> id) const noexcept
  {
    return std::hash<std::int64_t>{}(id.value);
  }
};
