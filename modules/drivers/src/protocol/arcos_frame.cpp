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
  m_bytes.erase(m_bytes.begin(), m_bytes.begin() + static_cast<std::ptrdiff_t>(m_begin));
  m_begin = 0;
  if (now - m_lastByte > kLongestPause) {
    m_bytes.clear(); // next() has taken the whole ones: what is left is a torn frame
  }
  m_lastByte = now;
  m_bytes.insert(m_bytes.end(), bytes.begin(), bytes.end());
}

std::optional<ArcosPacket> ArcosReader::next()
{
  constexpr std::size_t kHead = 3; // header and length
  constexpr std::size_t kSum = 2;
  while (m_bytes.size() >= m_begin + kHead) {
    const std::span<const std::uint8_t> rest = std::span(m_bytes).subspan(m_begin);
    const std::size_t length = rest[2];
    if (rest[0] != kHeader0 || rest[1] != kHeader1 || length < 1 + kSum) {
      ++m_begin;
      continue;
    }
    if (rest.size() < kHead + length) {
      return std::nullopt;
    }
    const auto content = rest.subspan(kHead, length - kSum);
    const unsigned sum = static_cast<unsigned>(rest[length + 1]) << 8U | rest[length + 2];
    if (sum != arcosChecksum(content)) {
      ++m_begin; // the length may be what is broken: look for a frame inside
      continue;
    }
    m_begin += kHead + length;
    return ArcosPacket{content.front(), Bytes(content.begin() + 1, content.end())};
  }
  return std::nullopt;
}

} // namespace homeward
