// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/drivers/protocol/arcos.h>

namespace homeward
{

/** Packets in which simulated Pioneers send what their laser sees. */
inline constexpr std::uint8_t kLaserPlain = 0x60;    ///< ranges and the robot's pose
inline constexpr std::uint8_t kLaserExtended = 0x61; ///< ranges and reflectance

/** Readings in one packet at most. */
inline constexpr std::size_t kLaserPartSize = 32;

/** A part of a sweep. Readings go counter-clockwise from the right end of the field of view. */
struct ArcosLaserPart
{
  std::uint8_t kind = kLaserPlain;   ///< kLaserPlain or what follows it
  std::uint16_t total = 0;           ///< readings in the sweep
  std::uint16_t first = 0;           ///< index of the first one here
  std::vector<std::uint16_t> ranges; ///< mm; 0 is nothing measured

  bool operator==(const ArcosLaserPart &) const = default;
};

/** The pose in a plain part is left at zero: clients use odometry. */
ArcosPacket encodeLaserPart(const ArcosLaserPart &part);

/** Nothing when it is another packet, one cut short, or one whose readings leave the sweep. */
std::optional<ArcosLaserPart> parseLaserPart(const ArcosPacket &packet);

/** A sweep as the packets that carry it. @throw LogicError with more than 65535 readings */
std::vector<ArcosPacket> encodeLaserSweep(std::uint8_t kind, std::span<const std::uint16_t> ranges);

/** Puts sweeps together again; a sweep of which a part is missing is dropped. */
class ArcosSweepReader
{
public:
  /** @return the ranges of a whole sweep, mm, when this part was its last */
  std::optional<std::vector<std::uint16_t>> add(const ArcosLaserPart &part);

private:
  std::vector<std::uint16_t> m_ranges;
};

} // namespace homeward
