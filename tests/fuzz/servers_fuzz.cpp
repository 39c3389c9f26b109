// SPDX-License-Identifier: GPL-3.0-or-later
#include "arcos_server.h"
#include "lms_server.h"

#include <cmath>
#include <cstdlib>

using namespace homeward;

namespace
{

class Base final : public MobileBase
{
public:
  void drive(const Twist2 &twist) override
  {
    if (!(std::abs(twist.v) <= 0.4) || !(std::abs(twist.w) <= 0.7)) {
      std::abort(); // whatever a client says, the limits hold
    }
  }
  BaseState state() override { return {}; }
};

class Laser final : public LaserScanner
{
public:
  std::optional<Scan> scan() override
  {
    return Scan{{}, -kPi / 2.0, kPi / 360.0, 15.0, std::vector<float>(361, 3.0F)};
  }
};

} // namespace

/** Whatever clients say to the simulated devices, these go on and keep their limits. */
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
  ArcosServer arcos(ArcosServerOptions{});
  LmsServer lms;
  Base base;
  Laser laser;
  Time now{};
  const auto tell = [&](const ArcosPacket &packet) { arcos.receive(frameArcos(packet), now); };
  tell(arcosCommand(ArcosCommand::Sync2));
  tell(arcosCommand(ArcosCommand::Open));
  tell(arcosCommand(ArcosCommand::Enable, 1));
  for (std::size_t at = 0; at + 1 < size;) { // one length byte, then a command or a payload
    const std::size_t length = std::min<std::size_t>(1U + data[at] % 40U, size - at - 1);
    const Bytes piece(data + at + 1, data + at + 1 + length);
    tell({piece[0], Bytes(piece.begin() + 1, piece.end())});
    lms.receive(frameSick({kSickHost, piece}), lms.baud());
    at += 1 + length;
    for (int i = 0; i < 6; ++i) {
      now += std::chrono::milliseconds(20);
      arcos.step(now, base, laser);
      (void)lms.step(std::chrono::milliseconds(20), laser);
    }
    (void)arcos.takeOutput();
  }
  return 0;
}
