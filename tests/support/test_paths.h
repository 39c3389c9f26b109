// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <gtest/gtest.h>

namespace homeward
{

/** data/ of this project. */
inline std::filesystem::path dataDir()
{
  return HOMEWARD_DATA_DIR;
}

/** tests/golden/ of this project. */
inline std::filesystem::path goldenDir()
{
  return HOMEWARD_GOLDEN_DIR;
}

/** A folder of data made by others, beside the checkout; it may be absent. */
inline std::filesystem::path outsideDataDir()
{
  return HOMEWARD_OUTSIDE_DATA_DIR;
}

} // namespace homeward

/** Skips the running test, by name, when data made by others is absent. `path` below the folder. */
#define HOMEWARD_NEEDS_OUTSIDE_DATA(path)                                                          \
  if (!std::filesystem::exists(homeward::outsideDataDir() / (path))) {                             \
    GTEST_SKIP() << "outside data absent: " << (path);                                             \
  }                                                                                                \
  static_assert(true, "")
