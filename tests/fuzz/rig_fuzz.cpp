// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/error.h>
#include <homeward/robot/rig.h>

#include <cstdint>

/** Any text is a rig file or is refused by name. */
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
  try {
    homeward::parseRig(std::string(reinterpret_cast<const char *>(data), size), "fuzz");
  }
  catch (const homeward::ConfigError &) {
    return 0;
  }
  return 0;
}
