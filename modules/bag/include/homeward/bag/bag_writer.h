// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/bag/bag_message.h>

#include <cstdint>
#include <filesystem>
#include <memory>

namespace homeward
{

/**
 * Writes a ROS 1 bag. Every 768 kB a chunk is closed; a bag that was never closed can be repaired
 * up to there, see repairBag().
 */
class BagWriter
{
public:
  /** @throw StoreError when the file cannot be written */
  explicit BagWriter(const std::filesystem::path &path, BagTopics topics = {});
  ~BagWriter();

  /**
   * Adds a message. Pictures become PNG: they are kept as they are.
   * @param message its time and stamps are ROS times, later than those before
   * @throw StoreError when it cannot be written
   */
  void write(const BagMessage &message);

  /** Bytes so far. */
  std::uint64_t size() const;

  /** Writes the index. @throw StoreError */
  void close();

private:
  class Impl;
  std::unique_ptr<Impl> m_impl;
};

} // namespace homeward
