// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "faults.h"

#include <homeward/drivers/protocol/arcos.h>
#include <homeward/robot/laser_scanner.h>
#include <homeward/robot/mobile_base.h>

#include <algorithm>
#include <span>

namespace homeward
{

/** A base whose wheels may be held. */
class FaultyBase final : public MobileBase
{
public:
  /** Both must outlive it. */
  FaultyBase(MobileBase &base, const Faults &faults) : m_base(base), m_faults(faults) {}

  void drive(const Twist2 &twist) override { m_base.drive(m_faults.heldWheels ? Twist2{} : twist); }

  BaseState state() override
  {
    BaseState state = m_base.state();
    state.stalled = state.stalled || m_faults.heldWheels;
    return state;
  }

private:
  MobileBase &m_base;
  const Faults &m_faults;
};

/** A laser that may be covered or mounted upside down. */
class FaultyLaser final : public LaserScanner
{
public:
  /** Both must outlive it. */
  FaultyLaser(LaserScanner &laser, const Faults &faults) : m_laser(laser), m_faults(faults) {}

  std::optional<Scan> scan() override
  {
    std::optional<Scan> scan = m_laser.scan();
    if (scan && m_faults.upsideDown) {
      std::reverse(scan->ranges.begin(), scan->ranges.end());
    }
    if (scan && m_faults.blindLaser) {
      std::fill(scan->ranges.begin(), scan->ranges.end(), kUnknownRange);
    }
    return scan;
  }

private:
  LaserScanner &m_laser;
  const Faults &m_faults;
};

/** What arrives of bytes that were sent at another speed, from the one at `begin` on. */
inline Bytes garbled(Bytes bytes, std::size_t begin = 0)
{
  for (std::uint8_t &byte : std::span(bytes).subspan(std::min(begin, bytes.size()))) {
    byte = static_cast<std::uint8_t>(byte * 3U ^ 0x5AU);
  }
  return bytes;
}

} // namespace homeward
