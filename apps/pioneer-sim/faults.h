// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <string>

namespace homeward
{

/** What is to go wrong, for those who test what their robot does then. Any thread may set it. */
struct Faults
{
  std::atomic<bool> silentBase{false};   ///< sends no packets; it still obeys
  std::atomic<bool> silentLaser{false};  ///< neither telegrams nor laser packets
  std::atomic<bool> silentCamera{false}; ///< sends no pictures
  std::atomic<bool> frozenCamera{false}; ///< sends the same picture again and again
  std::atomic<bool> halfPackets{false};  ///< the base sends the first half of each packet only

  /** The fault called `base`, `laser`, `camera`, `frozen` or `half`; null for any other. */
  std::atomic<bool> *find(const std::string &name)
  {
    return name == "base"     ? &silentBase
           : name == "laser"  ? &silentLaser
           : name == "camera" ? &silentCamera
           : name == "frozen" ? &frozenCamera
           : name == "half"   ? &halfPackets
                              : nullptr;
  }
};

} // namespace homeward
