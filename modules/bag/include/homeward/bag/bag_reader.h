// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/bag/bag_message.h>

#include <filesystem>
#include <memory>

namespace homeward
{

/** Reads the messages of a ROS 1 bag in the order of their times. */
class BagReader
{
public:
  /**
   * @param topics a topic that the bag does not have is replaced by the only one of that type, if
   * there is one
   * @throw StoreError, in one line, when the file is missing, no bag, or has no index
   */
  explicit BagReader(const std::filesystem::path &path, const BagTopics &topics = {});
  ~BagReader();

  /**
   * The next message; nothing at the end.
   * @throw StoreError when it cannot be read, or is a picture of an encoding other than mono8,
   * bgr8, rgb8, bgra8, rgba8 or a compressed one
   */
  std::optional<BagMessage> next();

private:
  class Impl;
  std::unique_ptr<Impl> m_impl;
};

} // namespace homeward
