// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace homeward
{

/** The simulator's streams of random numbers; the optics use others. */
enum class RandomStream : std::uint32_t
{
  Drive = 101,
  Laser = 102,
  Sonar = 103,
  Camera = 104
};

} // namespace homeward
