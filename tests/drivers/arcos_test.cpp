// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/error.h>
#include <homeward/core/random.h>
#include <homeward/drivers/protocol/arcos.h>

#include "bytes_of.h"

#include <gmock/gmock.h>

namespace homeward
{
namespace
{

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<ArcosPacket> readAll(ArcosReader &reader, std::span<const std::uint8_t> bytes,
                                 Time now = {})
{
  std::vector<ArcosPacket> packets;
  reader.push(bytes, now);
  while (const std::optional<ArcosPacket> packet = reader.next()) {
    packets.push_back(*packet);
  }
  return packets;
}

/** Frames seen on the wire between ARIA, Player and AMRISim. */
TEST(ArcosFrame, KnownCommands)
{
  const auto frame = [](auto... args) { return frameArcos(arcosCommand(args...)); };
  using enum ArcosCommand;
  EXPECT_EQ(frame(Sync0), bytesOf("FAFB03000000"));
  EXPECT_EQ(frame(Sync1), bytesOf("FAFB03010001"));
  EXPECT_EQ(frame(Sync2), bytesOf("FAFB03020002"));
  EXPECT_EQ(frame(Open, 1), bytesOf("FAFB06013B0100023B"));
  EXPECT_EQ(frame(Open), bytesOf("FAFB03010001"));
  EXPECT_EQ(frame(Pulse), bytesOf("FAFB03000000"));
  EXPECT_EQ(frame(Close, 1), bytesOf("FAFB06023B0100033B"));
  EXPECT_EQ(frame(Enable, 1), bytesOf("FAFB06043B0100053B"));
  EXPECT_EQ(frame(Enable, 0), bytesOf("FAFB06043B0000043B"));
  EXPECT_EQ(frame(SetV, 750), bytesOf("FAFB06063BEE02F43D"));
  EXPECT_EQ(frame(SetA, 300), bytesOf("FAFB06053B2C01313C"));
  EXPECT_EQ(frame(SetA, -300), bytesOf("FAFB06051B2C01311C"));
  EXPECT_EQ(frame(Vel, 300), bytesOf("FAFB060B3B2C01373C"));
  EXPECT_EQ(frame(Vel, 200), bytesOf("FAFB060B3BC800D33B"));
  EXPECT_EQ(frame(Vel, 0), bytesOf("FAFB060B3B00000B3B"));
  EXPECT_EQ(frame(RVel, 10), bytesOf("FAFB06153B0A001F3B"));
  EXPECT_EQ(frame(RVel, -10), bytesOf("FAFB06151B0A001F1B"));
  EXPECT_EQ(frame(Config, 1), bytesOf("FAFB06123B0100133B"));
  EXPECT_EQ(frame(Sonar, 0), bytesOf("FAFB061C3B00001C3B"));
  EXPECT_EQ(frameArcos({32, bytesOf("3B0C07")}), bytesOf("FAFB06203B0C072C42"));
  EXPECT_EQ(frame(static_cast<ArcosCommand>(36), -90), bytesOf("FAFB06241B5A007E1B"));
  EXPECT_EQ(frame(static_cast<ArcosCommand>(38), 100), bytesOf("FAFB06263B64008A3B"));
}

TEST(ArcosFrame, ArgumentsComeBack)
{
  for (const int argument : {0, 1, -1, 255, 256, -300, 32767, -32767}) {
    EXPECT_EQ(arcosArgument(arcosCommand(ArcosCommand::Vel, argument)), argument);
  }
  EXPECT_EQ(arcosArgument(arcosCommand(ArcosCommand::Open)), std::nullopt);
  EXPECT_EQ(arcosArgument({7, bytesOf("3B")}), std::nullopt); // as Player sends it
}

TEST(ArcosFrame, WhatDoesNotFitIsRefused)
{
  EXPECT_THROW(arcosCommand(ArcosCommand::Vel, 32768), LogicError);
  EXPECT_THROW(frameArcos({1, Bytes(201)}), LogicError);
}

TEST(ArcosReader, FindsFramesCutAnywhereAmongNoise)
{
  const std::vector<ArcosPacket> sent = {arcosCommand(ArcosCommand::Sync1),
                                         arcosCommand(ArcosCommand::Vel, 300),
                                         {0x32, Bytes(150, 0xFA)}};
  Bytes stream = bytesOf("574D53320D FA FA FB 00 FB");
  for (const ArcosPacket &packet : sent) {
    const Bytes frame = frameArcos(packet);
    stream.insert(stream.end(), frame.begin(), frame.end());
  }
  Random random(1, 0);
  for (int round = 0; round < 100; ++round) {
    ArcosReader reader;
    std::vector<ArcosPacket> packets;
    for (std::size_t begin = 0; begin < stream.size();) {
      const std::size_t size =
          std::min(stream.size() - begin, static_cast<std::size_t>(random.uniform(1.0, 40.0)));
      const auto part = readAll(reader, std::span(stream).subspan(begin, size));
      packets.insert(packets.end(), part.begin(), part.end());
      begin += size;
    }
    ASSERT_EQ(packets, sent);
  }
}

TEST(ArcosReader, ABadChecksumDropsThatFrameOnly)
{
  ArcosReader reader;
  Bytes stream = bytesOf("FAFB060B3B2C01373D"); // last byte is off by one
  const Bytes good = frameArcos(arcosCommand(ArcosCommand::Vel, 200));
  stream.insert(stream.end(), good.begin(), good.end());
  EXPECT_THAT(readAll(reader, stream), ElementsAre(arcosCommand(ArcosCommand::Vel, 200)));
}

TEST(ArcosReader, APauseInsideAFrameDropsIt)
{
  const Bytes frame = frameArcos(arcosCommand(ArcosCommand::Vel, 300));
  const std::span<const std::uint8_t> whole(frame);
  const Time start(std::chrono::seconds(5));
  for (const int pause : {99, 101}) {
    ArcosReader reader;
    readAll(reader, whole.first(5), start);
    const auto packets =
        readAll(reader, whole.subspan(5), start + std::chrono::milliseconds(pause));
    EXPECT_EQ(packets.size(), pause < 100 ? 1U : 0U) << pause;
    EXPECT_EQ(readAll(reader, frame, start + std::chrono::milliseconds(pause)).size(), 1U);
  }
}

TEST(ArcosIdentity, KnownAnswer)
{
  const Bytes frame = frameArcos(encodeIdentity({"AMRISim", "Pioneer", "p3at"}));
  EXPECT_EQ(frame.size(), 27U);
  ArcosReader reader;
  const std::optional<ArcosIdentity> identity = parseIdentity(readAll(reader, frame).at(0));
  ASSERT_TRUE(identity);
  EXPECT_EQ(identity->name, "AMRISim");
  EXPECT_EQ(identity->robotClass, "Pioneer");
  EXPECT_EQ(identity->subclass, "p3at");
  EXPECT_FALSE(parseIdentity({2, bytesOf("414200")}));
  EXPECT_FALSE(parseIdentity(arcosCommand(ArcosCommand::Sync1)));
}

ArcosSip atRest()
{
  ArcosSip sip;
  sip.battery = 0x82;
  sip.flags = 0x1F;
  sip.turnRate = 0;
  for (std::uint8_t i = 0; i < 16; ++i) {
    sip.sonars.push_back({i, 5000});
  }
  return sip;
}

TEST(ArcosSip, KnownSizesAndBytesOfARobotAtRest)
{
  ArcosSip sip = atRest();
  const Bytes frame = frameArcos(encodeSip(sip));
  EXPECT_EQ(frame.size(), 89U);
  const Bytes head = bytesOf("FAFB 56 32 0000 0000 0000 0000 0000 82 0000 0000 1F00 00 10");
  EXPECT_TRUE(std::equal(head.begin(), head.end(), frame.begin()));
  const Bytes tail = bytesOf("000000FFFF 8200 00 0000 0000 0000 81 00");
  EXPECT_TRUE(std::equal(tail.rbegin(), tail.rend(), frame.rbegin() + 2));
  sip.sonars.clear();
  EXPECT_EQ(frameArcos(encodeSip(sip)).size(), 41U);
}

TEST(ArcosSip, ComesBack)
{
  ArcosSip sip = atRest();
  sip.moving = true;
  sip.x = 0xFFF0;
  sip.y = 0x1234;
  sip.heading = -2048;
  sip.leftSpeed = -153;
  sip.rightSpeed = 153;
  sip.stall = 0x0101;
  sip.turnRate = -305;
  EXPECT_EQ(parseSip(encodeSip(sip)), sip);
  EXPECT_TRUE(sip.wheelStalled());
  sip.turnRate.reset();
  EXPECT_EQ(parseSip(encodeSip(sip)), sip);
}

TEST(ArcosSip, ShortPacketsAreNotReadPastTheirEnd)
{
  const ArcosPacket whole = encodeSip(atRest());
  for (std::size_t size = 0; size < 19 + 16 * 3; ++size) {
    EXPECT_FALSE(
        parseSip({kSipStopped, Bytes(whole.args.begin(),
                                     whole.args.begin() + static_cast<std::ptrdiff_t>(size))}));
  }
  EXPECT_FALSE(parseSip({0x20, whole.args}));
}

TEST(ArcosOdometry, CountersWrapAt15And16Bits)
{
  const ArcosUnits units = ArcosUnits::of("p3at").value();
  for (const int modulus : {1 << 15, 1 << 16}) {
    ArcosOdometry odometry(units);
    Pose2 pose;
    for (int x = 0; x <= 100000; x += 500) {
      ArcosSip sip;
      sip.x = static_cast<std::uint16_t>(x % modulus);
      sip.y = static_cast<std::uint16_t>((modulus - x % modulus) % modulus);
      pose = odometry.update(sip);
      ASSERT_NEAR(pose.x, x * 0.465e-3, 1e-9) << modulus;
      ASSERT_NEAR(pose.y, -x * 0.465e-3, 1e-9) << modulus;
    }
  }
}

TEST(ArcosOdometry, HeadingIsInRadians)
{
  ArcosOdometry odometry(ArcosUnits{});
  ArcosSip sip;
  sip.heading = 1024;
  EXPECT_NEAR(odometry.update(sip).heading, kPi / 2.0, 1e-4);
}

TEST(ArcosVelocity, FromTheTurnRateOrTheWheels)
{
  ArcosSip sip;
  sip.leftSpeed = 147; // 300 mm/s and 30 deg/s make +-153 on the wheels
  sip.rightSpeed = 453;
  const ArcosUnits units = ArcosUnits::of("p3at").value();
  EXPECT_NEAR(arcosVelocity(sip, units).v, 0.3, 1e-12);
  EXPECT_NEAR(arcosVelocity(sip, units).w, radians(30.0), radians(0.2));
  sip.turnRate = 295;
  EXPECT_NEAR(arcosVelocity(sip, units).w, radians(29.5), 1e-12);
}

TEST(ArcosUnits, AreKnownForTwoKindsOnly)
{
  EXPECT_DOUBLE_EQ(ArcosUnits::of("p3at-sh").value().distance, 1e-3);
  EXPECT_FALSE(ArcosUnits::of("seekur"));
}

} // namespace
} // namespace homeward
