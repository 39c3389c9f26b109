// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace homeward
{

/** What repairBag() did. */
struct BagRepair
{
  bool needed = false;        ///< the bag had no index
  std::size_t chunks = 0;     ///< in the new index
  std::size_t messages = 0;   ///< in those chunks
  std::uint64_t cutBytes = 0; ///< after the last closed chunk
};

/**
 * Gives a ROS 1 bag that was never closed, after a kill for example, its index: it then holds all
 * up to its last closed chunk. What comes after is cut off. A bag that has its index is left alone.
 * @throw StoreError when it is no ROS 1 bag of version 2.0, holds compressed chunks (rosbag reindex
 * mends those) or nothing that was closed
 */
BagRepair repairBag(const std::filesystem::path &path);

} // namespace homeward
