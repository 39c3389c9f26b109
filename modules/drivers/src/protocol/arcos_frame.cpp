// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/error.h>
#include <homeward/drivers/protocol/arcos.h>

#include <algorithm>
#include <cstdlib>

namespace homeward
{
namespace
{

constexpr std::uint8_t kHeader0 = 0xFA;
constexpr std::uint8_t kHeader1 = 0xFB;
constexpr std::size_t kLargestArgs = 200;
constexpr std::uint8_t kPositive = 0x3B;
constexpr std::uint8_t kNegative = 0x1B;
constexpr Duration kLongestPause = std::chrono::milliseconds(100);

} // namespace

std::uint16_t arcosChecksum(std::span<const std::uint8_t> idAndArgs)
{
  unsigned sum = 0;
  std::size_t i = 0;
  for (; i + 1 < idAndArgs.size(); i += 2) {
    sum = (sum + (static_cast<unsigned>(idAndArgs[i]) << 8U | idAndArgs[i + 1])) & 0xFFFFU;
  }
  if (i < idAndArgs.size()) {
    sum ^= idAndArgs[i];
  }
  return static_cast<std::uint16_t>(sum);
}

Bytes frameArcos(const ArcosPacket &packet)
{
  if (packet.args.size() > kLargestArgs) {
    throw LogicError("ARCOS packet with " + std::to_string(packet.args.size()) +
                     " bytes of arguments; 200 at most");
  }
  Bytes frame;
  frame.reserve(packet.args.size() + 6);
  for (const std::size_t byte : {std::size_t{kHeader0}, std::size_t{kHeader1},
                                 packet.args.size() + 3, std::size_t{packet.id}}) {
    frame.push_back(static_cast<std::uint8_t>(byte));
  }
  frame.insert(frame.end(), packet.args.begin(), packet.args.end());
  const std::uint16_t sum = arcosChecksum(std::span(frame).subspan(3));
  frame.push_back(static_cast<std::uint8_t>(sum >> 8U));
  frame.push_back(static_cast<std::uint8_t>(sum & 0xFFU));
  return frame;
}

ArcosPacket arcosCommand(ArcosCommand command)
{
  return {static_cast<std::uint8_t>(command), {}};
}

ArcosPacket arcosCommand(ArcosCommand command, int argument)
{
  const int size = std::abs(argument);
  if (size > 32767) {
    throw LogicError("ARCOS argument " + std::to_string(argument) + " is beyond 16 bits");
  }
  return {static_cast<std::uint8_t>(command),
          {argument < 0 ? kNegative : kPositive, static_cast<std::uint8_t>(size & 0xFF),
           static_cast<std::uint8_t>(size >> 8)}};
}

std::optional<int> arcosArgument(const ArcosPacket &command)
{
  const Bytes &args = command.args;
  if (args.size() < 3 || (args[0] != kPositive && args[0] != kNegative)) {
    return std::nullopt;
  }
  const int size = args[1] | (args[2] << 8);
  return args[0] == kNegative ? -size : size;
}

void ArcosReader::push(std::span<const std::uint8_t> bytes, Time now)
{
  if (bytes.empty()) {
    return;
  }
  if (now - m_lastByte > kLongestPause) {
    m_bytes.clear(); // next() has taken the whole ones: what is left is a torn frame
  }
  m_lastByte = now;
  m_bytes.insert(m_bytes.end(), bytes.begin(), bytes.end());
}

std::optional<ArcosPacket> ArcosReader::next()
{
  while (m_bytes.size() >= 3) {
    const std::size_t length = m_bytes[2];
    if (m_bytes[0] != kHeader0 || m_bytes[1] != kHeader1 || length < 3) {
      m_bytes.pop_front();
      continue;
    }
    if (m_bytes.size() < length + 3) {
      return std::nullopt;
    }
    const Bytes content(m_bytes.begin() + 3,
                        m_bytes.begin() + static_cast<std::ptrdiff_t>(length) + 1);
    const unsigned sum = static_cast<unsigned>(m_bytes[length + 1]) << 8U | m_bytes[length + 2];
    if (sum != arcosChecksum(content)) {
      m_bytes.pop_front(); // the length may be what is broken: look for a frame inside
      continue;
    }
    m_bytes.erase(m_bytes.begin(), m_bytes.begin() + static_cast<std::ptrdiff_t>(length) + 3);
    return ArcosPacket{content.front(), Bytes(content.begin() + 1, content.end())};
  }
  return std::nullopt;
}

} // namespace homeward
