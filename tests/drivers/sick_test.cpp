// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/angle.h>
#include <homeward/core/error.h>
#include <homeward/drivers/protocol/sick.h>

#include "bytes_of.h"

#include <gmock/gmock.h>

namespace homeward
{
namespace
{

using testing::ElementsAre;

std::vector<SickTelegram> readAll(SickReader &reader, std::span<const std::uint8_t> bytes)
{
  std::vector<SickTelegram> telegrams;
  reader.push(bytes);
  while (const std::optional<SickTelegram> telegram = reader.next()) {
    telegrams.push_back(*telegram);
  }
  return telegrams;
}

/** Telegrams seen on the wire of a LMS-2xx. */
TEST(SickFrame, KnownTelegrams)
{
  EXPECT_EQ(frameSick({kSickHost, {0x20, 0x25}}), bytesOf("020002002025 3508"));
  EXPECT_EQ(frameSick({kSickHost, {0x20, 0x24}}), bytesOf("020002002024 3408"));
  EXPECT_EQ(frameSick({kSickHost, {0x20, 0x40}}), bytesOf("020002002040 5008"));
  EXPECT_EQ(frameSick({kSickHost, {0x20, 0x42}}), bytesOf("020002002042 5208"));
  EXPECT_EQ(frameSick({kSickScanner, {0xA0, 0x00, 0x10}}), bytesOf("02800300A00010 160A"));
  EXPECT_THROW(frameSick({kSickHost, Bytes(813)}), LogicError);
}

TEST(SickReader, SkipsAcknowledgementsNoiseAndBrokenTelegrams)
{
  SickReader reader;
  const SickTelegram answer{kSickScanner, {0xA0, 0x00, 0x10}};
  EXPECT_THAT(readAll(reader, bytesOf("06 02800300A00010160A")), ElementsAre(answer));
  EXPECT_THAT(readAll(reader, bytesOf("15 FF 02 02800300A00010160B 06 02800300A00010160A")),
              ElementsAre(answer));
}

TEST(SickReader, TelegramsMayComeByteByByte)
{
  SickReader reader;
  std::vector<SickTelegram> telegrams;
  for (const std::uint8_t byte : bytesOf("06 02800300A00010160A 06 02800300A00010160A")) {
    for (const SickTelegram &telegram : readAll(reader, std::span(&byte, 1))) {
      telegrams.push_back(telegram);
    }
  }
  EXPECT_EQ(telegrams.size(), 2U);
}

TEST(SickScan, KnownSizes)
{
  const auto size = [](std::size_t counts) {
    return frameSick(encodeSickScan({0.001, true, std::vector<std::uint16_t>(counts), 0x10}))
        .size();
  };
  EXPECT_EQ(size(181), 372U);
  EXPECT_EQ(size(361), 732U);
}

TEST(SickScan, ComesBackAndShortOnesAreRefused)
{
  for (const double unit : {0.01, 0.001, 0.1}) {
    const SickScan scan{unit, false, {1, 2, 0xFFFF}, 0x10};
    const SickTelegram telegram = encodeSickScan(scan);
    EXPECT_EQ(parseSickScan(telegram), scan);
    for (std::size_t size = 0; size < telegram.payload.size(); ++size) {
      EXPECT_FALSE(parseSickScan(
          {kSickScanner, Bytes(telegram.payload.begin(),
                               telegram.payload.begin() + static_cast<std::ptrdiff_t>(size))}));
    }
  }
  EXPECT_FALSE(parseSickScan({kSickScanner, {0xA0, 0x00, 0x10}}));
}

TEST(SickRanges, GoFromRightToLeftWithoutFlags)
{
  const SickScan scan{0.001, true, {1500, 0x8000 | 2000, 3000}, 0x10};
  const Scan ranges = sickRanges(scan, 1, kPi, Time(std::chrono::seconds(3)));
  EXPECT_DOUBLE_EQ(ranges.angle(0), -kPi / 2.0);
  EXPECT_DOUBLE_EQ(ranges.angle(2), kPi / 2.0);
  EXPECT_THAT(ranges.ranges, ElementsAre(1.5F, 2.0F, 3.0F));
  EXPECT_EQ(ranges.stamp, Time(std::chrono::seconds(3)));
}

TEST(SickRanges, HighestCountsAreWords)
{
  for (const int flagBits : {1, 2, 3}) {
    const unsigned flags = 0xFFFFU & ~(0xFFFFU >> static_cast<unsigned>(flagBits));
    const auto count = [&](unsigned belowHighest) {
      return static_cast<std::uint16_t>(flags | (0xFFFFU - belowHighest));
    };
    const SickScan scan{0.001, true, {count(9), count(8), count(7), count(0)}, 0x10};
    const Scan ranges = sickRanges(scan, flagBits, kPi, {});
    EXPECT_LT(ranges.ranges[0], ranges.rangeMax);
    EXPECT_EQ(ranges.ranges[1], ranges.rangeMax);
    EXPECT_TRUE(std::isnan(ranges.ranges[2]));
    EXPECT_TRUE(std::isnan(ranges.ranges[3]));
  }
  EXPECT_THROW(sickRanges({0.001, true, {1, 2}, 0}, 4, kPi, {}), LogicError);
  EXPECT_THROW(sickRanges({0.001, true, {1}, 0}, 1, kPi, {}), LogicError);
}

} // namespace
} // namespace homeward
