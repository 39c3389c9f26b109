// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/error.h>
#include <homeward/drivers/protocol/arcos_laser.h>

#include <gtest/gtest.h>
#include <numeric>

namespace homeward
{
namespace
{

std::vector<std::uint16_t> stairs(std::size_t count)
{
  std::vector<std::uint16_t> ranges(count);
  std::iota(ranges.begin(), ranges.end(), std::uint16_t{500});
  return ranges;
}

/** Sizes seen on the wire of AMRISim. */
TEST(ArcosLaser, PacketsHaveTheirKnownSizes)
{
  const auto plain = encodeLaserSweep(kLaserPlain, stairs(361));
  ASSERT_EQ(plain.size(), 12U);
  EXPECT_EQ(frameArcos(plain.front()).size(), 81U);
  EXPECT_EQ(frameArcos(plain.back()).size(), 35U);
  const auto extended = encodeLaserSweep(kLaserExtended, stairs(181));
  ASSERT_EQ(extended.size(), 6U);
  EXPECT_EQ(frameArcos(extended.front()).size(), 173U);
}

TEST(ArcosLaser, SweepsComeBack)
{
  for (const std::uint8_t kind : {kLaserPlain, kLaserExtended}) {
    for (const std::size_t count : {1U, 31U, 32U, 33U, 181U, 361U}) {
      ArcosSweepReader reader;
      std::optional<std::vector<std::uint16_t>> sweep;
      for (const ArcosPacket &packet : encodeLaserSweep(kind, stairs(count))) {
        EXPECT_FALSE(sweep);
        const auto part = parseLaserPart(packet);
        ASSERT_TRUE(part);
        EXPECT_EQ(encodeLaserPart(*part), packet);
        sweep = reader.add(*part);
      }
      EXPECT_EQ(sweep, stairs(count));
    }
  }
}

TEST(ArcosLaser, ASweepWithAPartMissingIsDroppedAndTheNextOneRead)
{
  const auto packets = encodeLaserSweep(kLaserPlain, stairs(181));
  for (std::size_t missing = 0; missing < packets.size(); ++missing) {
    ArcosSweepReader reader;
    int whole = 0;
    for (int round = 0; round < 2; ++round) {
      for (std::size_t i = 0; i < packets.size(); ++i) {
        if (round == 1 || i != missing) {
          whole += reader.add(*parseLaserPart(packets[i])) ? 1 : 0;
        }
      }
    }
    EXPECT_EQ(whole, 1) << missing;
  }
}

TEST(ArcosLaser, APartThatComesTwiceMakesUpForNoOther)
{
  const auto packets = encodeLaserSweep(kLaserPlain, stairs(181));
  ArcosSweepReader reader;
  for (const std::size_t i : {0U, 2U, 2U, 3U, 4U, 5U}) {
    EXPECT_FALSE(reader.add(*parseLaserPart(packets[i])));
  }
}

TEST(ArcosLaser, PartsCutShortOrBeyondTheSweepAreRefused)
{
  for (const std::uint8_t kind : {kLaserPlain, kLaserExtended}) {
    const ArcosPacket packet = encodeLaserPart({kind, 40, 32, stairs(8)});
    const std::size_t optional = kind == kLaserExtended ? 2 : 0; // the laser's index, flags
    for (std::size_t size = 0; size + optional < packet.args.size(); ++size) {
      EXPECT_FALSE(
          parseLaserPart({kind, Bytes(packet.args.begin(),
                                      packet.args.begin() + static_cast<std::ptrdiff_t>(size))}));
    }
    EXPECT_FALSE(parseLaserPart(encodeLaserPart({kind, 39, 32, stairs(8)})));
  }
  EXPECT_FALSE(parseLaserPart({0x62, Bytes(50)}));
  EXPECT_THROW(encodeLaserSweep(kLaserPlain, std::vector<std::uint16_t>(65536)), LogicError);
}

} // namespace
} // namespace homeward
