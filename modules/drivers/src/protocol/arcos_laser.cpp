// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/error.h>
#include <homeward/drivers/protocol/arcos_laser.h>

#include "field_reader.h"
#include "field_writer.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace homeward
{
namespace
{

constexpr std::size_t kPoseSize = 6;        ///< x, y, heading
constexpr std::size_t kReflectanceSize = 3; ///< after each range of an extended part

} // namespace

ArcosPacket encodeLaserPart(const ArcosLaserPart &part)
{
  const bool extended = part.kind == kLaserExtended;
  ArcosPacket packet{part.kind, {}};
  FieldWriter writer(packet.args);
  writer.zeros(extended ? 0 : kPoseSize);
  writer.u16(part.total);
  writer.u16(part.first);
  writer.u8(static_cast<std::uint8_t>(part.ranges.size()));
  for (const std::uint16_t range : part.ranges) {
    writer.u16(range);
    writer.zeros(extended ? kReflectanceSize : 0);
  }
  writer.zeros(extended ? 2 : 0); // the laser's index, flags
  return packet;
}

std::optional<ArcosLaserPart> parseLaserPart(const ArcosPacket &packet)
{
  const bool extended = packet.id == kLaserExtended;
  if (!extended && packet.id != kLaserPlain) {
    return std::nullopt;
  }
  FieldReader reader(packet.args);
  reader.skip(extended ? 0 : kPoseSize);
  ArcosLaserPart part;
  part.kind = packet.id;
  part.total = reader.u16();
  part.first = reader.u16();
  const std::size_t count = reader.u8();
  for (std::size_t i = 0; i < count; ++i) {
    part.ranges.push_back(reader.u16());
    reader.skip(extended ? kReflectanceSize : 0);
  }
  return reader.ok() && part.first + count <= part.total ? std::optional(std::move(part))
                                                         : std::nullopt;
}

std::vector<ArcosPacket> encodeLaserSweep(std::uint8_t kind, std::span<const std::uint16_t> ranges)
{
  if (ranges.size() > std::numeric_limits<std::uint16_t>::max()) {
    throw LogicError("laser sweep with " + std::to_string(ranges.size()) + " readings");
  }
  std::vector<ArcosPacket> packets;
  for (std::size_t first = 0; first < ranges.size(); first += kLaserPartSize) {
    const auto part = ranges.subspan(first, std::min(kLaserPartSize, ranges.size() - first));
    packets.push_back(encodeLaserPart({kind,
                                       static_cast<std::uint16_t>(ranges.size()),
                                       static_cast<std::uint16_t>(first),
                                       {part.begin(), part.end()}}));
  }
  return packets;
}

std::optional<std::vector<std::uint16_t>> ArcosSweepReader::add(const ArcosLaserPart &part)
{
  if (part.first == 0) {
    m_ranges.clear();
  }
  if (part.first != m_ranges.size()) {
    m_ranges.clear();
    return std::nullopt;
  }
  m_ranges.insert(m_ranges.end(), part.ranges.begin(), part.ranges.end());
  if (m_ranges.empty() || m_ranges.size() < part.total) {
    return std::nullopt;
  }
  return std::exchange(m_ranges, {});
}

} // namespace homeward
