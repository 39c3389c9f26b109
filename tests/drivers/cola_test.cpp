// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/angle.h>
#include <homeward/core/error.h>
#include <homeward/drivers/protocol/cola.h>

#include "bytes_of.h"

#include <gmock/gmock.h>

namespace homeward
{
namespace
{

using testing::ElementsAre;

std::vector<std::string> readAll(ColaReader &reader, std::string_view bytes)
{
  std::vector<std::string> telegrams;
  reader.push(Bytes(bytes.begin(), bytes.end()));
  while (std::optional<std::string> telegram = reader.next()) {
    telegrams.push_back(*std::move(telegram));
  }
  return telegrams;
}

// The examples of SICK's Telegram Listing Ranging Sensors (8014631) for a LMS1xx.
constexpr std::string_view kStart = "02 73454E 20 4C4D447363616E64617461 20 31 03";
constexpr std::string_view kScan = "sRA LMDscandata 1 1 89A27F 0 0 343 347 27477BA9 2747813B 0 0 7 "
                                   "0 0 1388 168 0 1 DIST1 3F800000 "
                                   "00000000 186A0 1388 15 8A1 8A5 8AB 8AC 8A6 8AC 8B6 8C8 8C2 8C9 "
                                   "8CB 8C4 8E4 8E1 8EB 8E0 8F5 908 "
                                   "8FC 907 906 0 0 0 0 0 0";

TEST(ColaFrame, KnownTelegram)
{
  EXPECT_EQ(frameCola("sEN LMDscandata 1"), bytesOf(kStart));
  EXPECT_THROW(frameCola("a\x03"), LogicError);
}

TEST(ColaReader, SkipsNoiseAndTelegramsWithoutAStartOrAnEnd)
{
  ColaReader reader;
  EXPECT_THAT(readAll(reader, "noise\x02one\x03 \x03\x03lost\x03\x02half\x02two\x03\x02th"),
              ElementsAre("one", "two"));
  EXPECT_THAT(readAll(reader, "ree\x03"), ElementsAre("three"));
}

TEST(ColaReader, TelegramsMayComeByteByByte)
{
  ColaReader reader;
  std::vector<std::string> telegrams;
  for (const char byte : std::string("\x02one\x03\x02two\x03")) {
    for (const std::string &telegram : readAll(reader, std::string_view(&byte, 1))) {
      telegrams.push_back(telegram);
    }
  }
  EXPECT_THAT(telegrams, ElementsAre("one", "two"));
}

TEST(ColaReader, AGiantIsGivenUp)
{
  ColaReader reader;
  EXPECT_TRUE(readAll(reader, "\x02" + std::string(70000, 'x')).empty());
  EXPECT_TRUE(readAll(reader, "rest\x03").empty());
  EXPECT_THAT(readAll(reader, "\x02one\x03"), ElementsAre("one"));
}

TEST(ColaScan, KnownTelegram)
{
  const std::optional<ColaScan> scan = parseColaScan(kScan);
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->sent - scan->begun, 1426U);
  EXPECT_EQ(scan->startAngle, 100000);
  EXPECT_EQ(scan->angleStep, 5000);
  ASSERT_EQ(scan->counts.size(), 21U);
  const Scan ranges = colaRanges(*scan, 20.0, Time(std::chrono::seconds(3)));
  EXPECT_NEAR(ranges.angle(0), radians(-80.0), 1e-9);
  EXPECT_NEAR(ranges.angle(20), radians(-70.0), 1e-9);
  EXPECT_FLOAT_EQ(ranges.ranges[0], 2.209F);
  EXPECT_FLOAT_EQ(ranges.ranges[20], 2.310F);
  EXPECT_EQ(ranges.stamp, Time(std::chrono::seconds(3)));
}

/** Distances are found behind encoders and other channels; a negative angle is a complement or
 * bears a sign. */
TEST(ColaScan, DistancesAreFoundAmongOtherThings)
{
  const std::string head = "sSN LMDscandata 1 1 A 0 0 1 2 10 20 0 0 0 0 0 1388 168 ";
  const std::string energies = "RSSI1 3F800000 0 FFF92230 1388 1 FE ";
  for (const std::string angle : {"FFF92230", "-450000"}) {
    std::string text = head;
    text.append("1 3E8 2 2 ").append(energies).append("DIST1 40000000 0 ").append(angle);
    const auto scan = parseColaScan(text.append(" +2500 2 7D0 3 0 0 0 0 0 0"));
    ASSERT_TRUE(scan);
    const Scan ranges = colaRanges(*scan, 20.0, {});
    EXPECT_NEAR(ranges.angleMin, radians(-135.0), 1e-9);
    EXPECT_NEAR(ranges.angleStep, radians(0.25), 1e-9);
    EXPECT_FLOAT_EQ(ranges.ranges[0], 4.0F);   // scale 2
    EXPECT_TRUE(std::isnan(ranges.ranges[1])); // a word
  }
  EXPECT_FALSE(parseColaScan(head + "0 1 " + energies + "0 0 0 0 0 0"));
}

TEST(ColaScan, ComesBackAndShortOnesAreRefused)
{
  const ColaScan scan{0xFFFFFFF0U, 16U, 2.0F, 0.0F, -450000, 2500, {0, 1, 65535}};
  const std::string text = encodeColaScan(scan);
  EXPECT_EQ(parseColaScan(text), scan);
  const std::size_t lastCount = text.rfind(" FFFF");
  for (std::size_t size = 0; size <= lastCount; ++size) {
    EXPECT_FALSE(parseColaScan(text.substr(0, size))) << size;
  }
  EXPECT_FALSE(parseColaScan("sRA STlms 7"));
  EXPECT_THROW(colaRanges({}, 20.0, {}), LogicError);
}

} // namespace
} // namespace homeward
