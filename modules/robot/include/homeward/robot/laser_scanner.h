// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/scan.h>

#include <optional>

namespace homeward
{

/** Something that measures ranges in a plane. */
class LaserScanner
{
public:
  virtual ~LaserScanner() = default;

  /** The newest scan in the laser's frame; nothing before the first. @throw DeviceError when it is
   * gone */
  virtual std::optional<Scan> scan() = 0;
};

} // namespace homeward
