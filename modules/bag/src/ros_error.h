// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/error.h>

#include <exception>
#include <filesystem>
#include <string>

namespace homeward
{

/** Does something with a bag. @throw StoreError, in one line, for whatever ROS throws */
template <class Work>
auto withBag(const std::filesystem::path &path, const std::string &advice, Work work)
{
  try {
    return work();
  }
  catch (const RuntimeError &) {
    throw;
  }
  catch (const std::exception &error) {
    throw StoreError("the bag " + path.string() + ": " + error.what() + "; " + advice);
  }
}

} // namespace homeward
