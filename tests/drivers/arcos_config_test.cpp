// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/drivers/protocol/arcos_config.h>

#include "bytes_of.h"

#include <gtest/gtest.h>

namespace homeward
{
namespace
{

/** As AMRISim's: class and subclass as it says them, 16 bytes of other strings. */
ArcosConfig example()
{
  ArcosConfig config;
  config.serial = "SIM";
  config.name = "AMRISim";
  config.firmware = "1.0";
  config.speedMax = 700;
  config.watchdog = 1234;
  config.rearSonar = 0;
  return config;
}

TEST(ArcosConfig, HasTheSizeThatAMRISimsHas)
{
  EXPECT_EQ(frameArcos(encodeConfig(example())).size(), 124U);
}

TEST(ArcosConfig, FieldsStandWhereClientsLook)
{
  const Bytes args = encodeConfig(example()).args;
  EXPECT_EQ(Bytes(args.begin(), args.begin() + 13), bytesOf("50696F6E65657200 7033617400"));
  // After three strings and one byte: 300 deg/s, 1200 mm/s.
  EXPECT_EQ(Bytes(args.begin() + 18, args.begin() + 22), bytesOf("2C01 B004"));
  // After the tops, the PWM and the name: the cycle in milliseconds.
  EXPECT_EQ(args.at(36), 100);
}

TEST(ArcosConfig, ComesBackAndShortOnesAreRefused)
{
  const ArcosPacket packet = encodeConfig(example());
  EXPECT_EQ(parseConfig(packet), example());
  for (std::size_t size = 0; size < packet.args.size(); ++size) {
    EXPECT_FALSE(
        parseConfig({packet.id, Bytes(packet.args.begin(),
                                      packet.args.begin() + static_cast<std::ptrdiff_t>(size))}));
  }
  ArcosPacket newer = packet;
  newer.args.insert(newer.args.end(), 20, 7); // newer robots append more
  EXPECT_EQ(parseConfig(newer), example());
  EXPECT_FALSE(parseConfig({0x21, packet.args}));
}

} // namespace
} // namespace homeward
