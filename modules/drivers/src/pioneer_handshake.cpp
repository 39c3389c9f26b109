// SPDX-License-Identifier: GPL-3.0-or-later
#include "pioneer_handshake.h"

#include <homeward/core/error.h>
#include <homeward/drivers/steady_clock.h>

#include <array>
#include <string>

namespace homeward
{
namespace
{

constexpr int kTries = 5;
constexpr Duration kPauseBeforeOpen = std::chrono::milliseconds(100);

enum class Answer
{
  Came,
  Streaming, ///< the robot is open already
  None
};

/** Reads until `wanted` comes, into `packet`. */
Answer await(ByteStream &stream, ArcosReader &reader, std::uint8_t wanted, Duration timeout,
             ArcosPacket &packet)
{
  const SteadyClock clock;
  const Time deadline = clock.now() + timeout;
  std::array<std::uint8_t, 512> buffer{};
  for (Time now = clock.now(); now < deadline; now = clock.now()) {
    const std::size_t count = stream.read(buffer, deadline - now);
    reader.push(std::span(buffer).first(count), clock.now());
    while (const std::optional<ArcosPacket> next = reader.next()) {
      if (next->id == wanted) {
        packet = *next;
        return Answer::Came;
      }
      if (next->id == kSipStopped || next->id == kSipMoving) {
        return Answer::Streaming;
      }
    }
  }
  return Answer::None;
}

/** Reads away what still comes for `span`, for example an echo that was late. */
void drain(ByteStream &stream, ArcosReader &reader, Duration span)
{
  const SteadyClock clock;
  const Time deadline = clock.now() + span;
  std::array<std::uint8_t, 512> buffer{};
  for (Time now = clock.now(); now < deadline; now = clock.now()) {
    const std::size_t count = stream.read(buffer, deadline - now);
    reader.push(std::span(buffer).first(count), clock.now());
    while (reader.next()) {
    }
  }
}

/** One try. @return what the robot says of itself, when it did. @param heard set by any packet */
std::optional<ArcosIdentity> tryHands(ByteStream &stream, ArcosReader &reader, Duration timeout,
                                      bool &heard)
{
  constexpr std::array kSteps = {ArcosCommand::Sync0, ArcosCommand::Sync1, ArcosCommand::Sync2};
  ArcosPacket packet;
  Answer answer = Answer::Came;
  for (std::size_t step = 0; step < kSteps.size() && answer == Answer::Came; ++step) {
    stream.write(frameArcos(arcosCommand(kSteps[step])));
    answer = await(stream, reader, static_cast<std::uint8_t>(kSteps[step]), timeout, packet);
    heard = heard || answer != Answer::None;
  }
  if (answer == Answer::Came) {
    if (std::optional<ArcosIdentity> identity = parseIdentity(packet)) {
      drain(stream, reader, kPauseBeforeOpen);
      stream.write(frameArcos(arcosCommand(ArcosCommand::Open, 1)));
      return identity;
    }
  }
  if (answer == Answer::Streaming) {
    stream.write(frameArcos(arcosCommand(ArcosCommand::Close, 1)));
    drain(stream, reader, kPauseBeforeOpen);
  }
  return std::nullopt;
}

std::string listed(const std::vector<int> &bauds)
{
  std::string text;
  for (const int baud : bauds) {
    text += (text.empty() ? "" : ", ") + std::to_string(baud);
  }
  return text;
}

} // namespace

ArcosConnection shakeHands(ByteStream &stream, ArcosReader &reader, Duration timeout,
                           const std::vector<int> &bauds)
{
  constexpr int kRounds = 2; // what came first may have been lost
  const std::vector<int> speeds = bauds.empty() ? std::vector<int>{0} : bauds;
  const bool one = speeds.size() == 1;
  for (int round = 0; round < (one ? kTries : kRounds); ++round) {
    for (const int baud : speeds) {
      if (baud != 0) {
        stream.setBaud(baud);
      }
      reader = ArcosReader();
      bool heard = true;
      for (int attempt = 0; attempt < kTries && heard; ++attempt) {
        heard = false;
        if (const auto identity = tryHands(stream, reader, timeout, heard)) {
          return {*identity, baud};
        }
      }
    }
  }
  throw DeviceError(
      "no Pioneer answers" +
      (one ? std::string("; is it on, and are cable, port and speed right?")
           : " at " + listed(bauds) + " baud; is it on, and are cable and port right?"));
}

} // namespace homeward
