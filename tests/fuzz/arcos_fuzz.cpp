// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/drivers/protocol/arcos.h>
#include <homeward/drivers/protocol/arcos_config.h>
#include <homeward/drivers/protocol/arcos_laser.h>

#include <cstdlib>

using namespace homeward;

namespace
{

void require(bool law)
{
  if (!law) {
    std::abort();
  }
}

/** What is read and written again reads the same. */
void readPacket(const ArcosPacket &packet, ArcosOdometry &odometry, ArcosSweepReader &sweeps)
{
  (void)arcosArgument(packet);
  if (const auto identity = parseIdentity(packet)) {
    require(parseIdentity(encodeIdentity(*identity)).has_value());
  }
  if (const auto config = parseConfig(packet)) {
    require(parseConfig(encodeConfig(*config)) == config);
  }
  if (const auto part = parseLaserPart(packet)) {
    require(parseLaserPart(encodeLaserPart(*part)) == part);
    (void)sweeps.add(*part);
  }
  if (const auto sip = parseSip(packet)) {
    require(parseSip(encodeSip(*sip)) == sip);
    (void)odometry.update(*sip);
    (void)arcosVelocity(*sip, ArcosUnits{});
  }
}

} // namespace

/** A stream of bytes in pieces of the size that its first byte says, and a packet as it stands. */
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
  if (size < 2) {
    return 0;
  }
  const std::span<const std::uint8_t> bytes(data + 1, size - 1);
  const std::size_t piece = data[0] % 64U + 1U;
  ArcosReader reader;
  ArcosOdometry odometry{ArcosUnits{}};
  ArcosSweepReader sweeps;
  for (std::size_t begin = 0; begin < bytes.size(); begin += piece) {
    reader.push(bytes.subspan(begin, std::min(piece, bytes.size() - begin)), Time{});
    while (const auto packet = reader.next()) {
      require(packet->args.size() <= 252);
      readPacket(*packet, odometry, sweeps);
    }
  }
  readPacket({bytes[0], Bytes(bytes.begin() + 1, bytes.end())}, odometry, sweeps);
  return 0;
}
