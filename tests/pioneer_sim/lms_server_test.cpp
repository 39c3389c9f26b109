// SPDX-License-Identifier: GPL-3.0-or-later
#include "../drivers/bytes_of.h"
#include "lms_server.h"

#include <homeward/core/angle.h>
#include <homeward/drivers/protocol/sick_commands.h>

#include <gmock/gmock.h>

namespace homeward
{
namespace
{

using testing::ElementsAre;

/** Half degrees; 2 m all round, nothing at all ahead, open to the left. */
class PlainLaser final : public LaserScanner
{
public:
  std::optional<Scan> scan() override
  {
    Scan scan;
    scan.angleMin = -kPi / 2.0;
    scan.angleStep = radians(0.5);
    scan.rangeMax = 15.0;
    scan.ranges.assign(361, 2.0F);
    scan.ranges[180] = kUnknownRange;
    scan.ranges[360] = 15.0F;
    return scan;
  }
};

class LmsServerTest : public testing::Test
{
protected:
  void ask(const Bytes &payload, int baud)
  {
    server.receive(frameSick({kSickHost, payload}), baud);
  }

  /** Bytes that come within so many seconds. */
  Bytes listen(double seconds)
  {
    Bytes all;
    for (double passed = 0.0; passed < seconds - 0.01; passed += 0.02) {
      const Bytes some = server.step(std::chrono::milliseconds(20), laser);
      all.insert(all.end(), some.begin(), some.end());
    }
    return all;
  }

  static std::vector<SickTelegram> telegrams(const Bytes &bytes)
  {
    SickReader reader;
    reader.push(bytes);
    std::vector<SickTelegram> result;
    while (const std::optional<SickTelegram> telegram = reader.next()) {
      result.push_back(*telegram);
    }
    return result;
  }

  void toMillimetres()
  {
    ask({0x20, 0x40}, 9600);
    listen(0.1);
    ask(bytesOf("20 00 5349434B5F4C4D53"), 38400);
    ask(bytesOf("77 0000 4600 00 06 01"), 38400);
    listen(0.5);
  }

  LmsServer server;
  PlainLaser laser;
};

/** Seen on the wire of a LMS-2xx. */
TEST_F(LmsServerTest, AcknowledgesAndAnswersToTheByte)
{
  ask({0x20, 0x25}, 9600);
  EXPECT_EQ(listen(0.1), bytesOf("06 02800300A00010160A"));
}

TEST_F(LmsServerTest, IsDeafAtTheWrongSpeedAndChangesItAfterItsAnswer)
{
  ask({0x20, 0x25}, 38400);
  EXPECT_TRUE(listen(0.1).empty());
  ask({0x20, 0x40}, 9600);
  EXPECT_EQ(server.baud(), 9600);
  EXPECT_EQ(listen(0.1).size(), 10U);
  EXPECT_EQ(server.baud(), 38400);
  ask({0x20, 0x25}, 38400);
  EXPECT_EQ(listen(0.1).size(), 10U);
}

TEST_F(LmsServerTest, IsNoFasterThanItsLine)
{
  toMillimetres();
  ask({0x20, 0x24}, 38400);
  // 3840 bytes a second.
  EXPECT_NEAR(static_cast<double>(listen(10.0).size()), 38400.0, 400.0);
  // 372 bytes take 96.9 ms: 10.3 scans a second.
  EXPECT_NEAR(static_cast<double>(telegrams(listen(10.0)).size()), 103.0, 2.0);
}

TEST_F(LmsServerTest, MeasuresInMillimetresWithItsWordsForNothing)
{
  toMillimetres();
  ask({0x3B, 180, 0, 50, 0}, 38400);
  ask({0x20, 0x24}, 38400);
  std::optional<SickScan> scan;
  for (const SickTelegram &telegram : telegrams(listen(1.0))) {
    if (auto next = parseSickScan(telegram)) {
      scan = next;
    }
  }
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->unit, 0.001);
  ASSERT_EQ(scan->counts.size(), 361U);
  EXPECT_EQ(scan->counts[0], 2000U);
  const Scan ranges = sickRanges(*scan, 1, kPi, {});
  EXPECT_TRUE(std::isnan(ranges.ranges[180]));
  EXPECT_EQ(ranges.ranges[360], ranges.rangeMax);
}

TEST_F(LmsServerTest, ItsMemoryIsWrittenWithThePasswordOnly)
{
  ask(bytesOf("77 0000 4600 00 06 01"), 9600);
  EXPECT_EQ(telegrams(listen(0.5)).at(0).payload.at(1), 0);
  ask(bytesOf("20 00 5349434B5F4C4D54"), 9600);
  EXPECT_THAT(telegrams(listen(0.5)).at(0).payload, ElementsAre(0xA0, 1, 0x10));
  ask(bytesOf("20 00 5349434B5F4C4D53"), 9600);
  ask(bytesOf("77 0000 4600 00 06 01"), 9600);
  ask({0x74}, 9600);
  const auto answers = telegrams(listen(1.0));
  EXPECT_EQ(answers.at(1).payload.at(1), 1);
  EXPECT_EQ(answers.at(2).payload.at(1 + sick::kMeasuringModeAt), 6);
  EXPECT_EQ(answers.at(2).payload.at(1 + sick::kUnitAt), 1);
}

TEST_F(LmsServerTest, WhatItCannotMeasureIsRefused)
{
  for (const auto &[payload, done] : {std::pair{bytesOf("3B B400 3200"), 1},
                                      {bytesOf("3B 6400 1900"), 1},
                                      {bytesOf("3B B400 1900"), 0},
                                      {bytesOf("3B 5A00 6400"), 0},
                                      {bytesOf("3B B4"), 0}}) {
    ask(payload, 9600);
    EXPECT_EQ(telegrams(listen(0.2)).at(0).payload.at(1), done);
  }
}

TEST_F(LmsServerTest, SaysWhatItIs)
{
  ask({0x3A}, 9600);
  const Bytes type = telegrams(listen(0.5)).at(0).payload;
  EXPECT_EQ(std::string(type.begin() + 1, type.begin() + 7), "LMS200");
  ask({0x31}, 9600);
  const Bytes status = telegrams(listen(0.5)).at(0).payload;
  ASSERT_EQ(status.size(), 153U);
  EXPECT_EQ(status[107], 180);
  EXPECT_EQ(status[109], 100);
}

TEST_F(LmsServerTest, StartsAnewAfterAReset)
{
  toMillimetres();
  ask({0x10}, 38400);
  const auto said = telegrams(listen(1.0));
  EXPECT_EQ(said.at(0).payload.at(0), 0x91);
  EXPECT_EQ(said.at(1).payload.at(0), 0x90);
  EXPECT_EQ(server.baud(), 9600);
}

TEST_F(LmsServerTest, AFloodOfQuestionsEndsInAFullQueueAndNothingElse)
{
  for (int i = 0; i < 100000; ++i) {
    ask({0x31}, 9600);
  }
  ask({0xEE}, 9600);
  EXPECT_LT(listen(60.0).size(), 20000U);
  ask({0x20, 0x25}, 9600);
  EXPECT_EQ(listen(0.2).size(), 10U);
}

} // namespace
} // namespace homeward
