// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/drivers/protocol/arcos.h>

#include "fake_device.h"

#include <algorithm>
#include <termios.h>
#include <vector>

namespace homeward
{

/**
 * A robot that shakes hands, believes its orders and sends a SIP every 20 ms. Over a
 * pseudo-terminal it may have a speed: at any other that its client has set, both hear only noise.
 */
class FakePioneer final : public FakeDevice
{
public:
  explicit FakePioneer(int descriptor, std::string subclass = "p3at-sh", bool open = false,
                       speed_t speed = B0)
      : FakeDevice(descriptor), m_descriptor(descriptor), m_speed(speed),
        m_subclass(std::move(subclass)), m_open(open)
  {
    start();
  }
  ~FakePioneer() override { stop(); }

  /** True when the commands came in this order, others between them allowed. */
  bool heard(const std::vector<ArcosPacket> &wanted)
  {
    return eventually([&] {
      auto next = wanted.begin();
      for (const ArcosPacket &command : m_heard) {
        if (next != wanted.end() && command == *next) {
          ++next;
        }
      }
      return next == wanted.end();
    });
  }

  /** Whether such a command has come so far. */
  bool hasHeard(const ArcosPacket &command)
  {
    const std::lock_guard lock(m_mutex);
    return std::find(m_heard.begin(), m_heard.end(), command) != m_heard.end();
  }

  void forget()
  {
    const std::lock_guard lock(m_mutex);
    m_heard.clear();
  }

  /** Sends no more packets, as if a cable were cut on one side. */
  void fallSilent()
  {
    const std::lock_guard lock(m_mutex);
    m_silent = true;
  }

  /** Goes over the counters of the wheels that it has driven. */
  void setPosition(std::uint16_t x)
  {
    const std::lock_guard lock(m_mutex);
    m_sip.x = x;
  }

  void setSonars(std::vector<ArcosSonar> sonars)
  {
    const std::lock_guard lock(m_mutex);
    m_sip.sonars = std::move(sonars);
  }

  /** See ArcosSip::stall. */
  void setStall(std::uint16_t bits)
  {
    const std::lock_guard lock(m_mutex);
    m_sip.stall = bits;
  }

  /** See ArcosSip::battery. */
  void setBattery(std::uint8_t tenthVolts)
  {
    const std::lock_guard lock(m_mutex);
    m_sip.battery = tenthVolts;
  }

  /** See ArcosSip::flags. */
  void setFlags(std::uint16_t bits)
  {
    const std::lock_guard lock(m_mutex);
    m_sip.flags = bits;
  }

private:
  static constexpr Duration kCycle = std::chrono::milliseconds(20);

  void serve(std::span<const std::uint8_t> bytes, Time now) override
  {
    m_reader.push(overTheLine(bytes), now);
    while (const std::optional<ArcosPacket> packet = m_reader.next()) {
      m_heard.push_back(*packet);
      obey(*packet);
    }
    if (m_open && !m_silent && now - m_lastSip >= kCycle) {
      m_lastSip = now;
      m_sip.x = static_cast<std::uint16_t>(m_sip.x + m_sip.leftSpeed / 50);
      send(overTheLine(frameArcos(encodeSip(m_sip))));
    }
  }

  /** What arrives of bytes; a pseudo-terminal's device sees the speed that the client has set. */
  Bytes overTheLine(std::span<const std::uint8_t> bytes) const
  {
    Bytes arrived(bytes.begin(), bytes.end());
    termios line{};
    if (m_speed != B0 && ::tcgetattr(m_descriptor, &line) == 0 && ::cfgetospeed(&line) != m_speed) {
      for (std::uint8_t &byte : arrived) {
        byte = static_cast<std::uint8_t>(static_cast<unsigned>(byte) << 1U | 0x81U);
      }
    }
    return arrived;
  }

  void obey(const ArcosPacket &packet)
  {
    const auto is = [&](ArcosCommand command) {
      return packet.id == static_cast<std::uint8_t>(command);
    };
    if (!m_open) {
      if (is(ArcosCommand::Open) && m_synced) {
        m_open = true;
      }
      else if (is(ArcosCommand::Sync2)) {
        m_synced = true;
        send(overTheLine(frameArcos(encodeIdentity({"fake", "Pioneer", m_subclass}))));
      }
      else {
        send(overTheLine(frameArcos(packet)));
      }
    }
    else if (is(ArcosCommand::Close)) {
      m_open = m_synced = false;
    }
    else if (is(ArcosCommand::Enable)) {
      const bool on = arcosArgument(packet).value_or(0) != 0 && !m_sip.emergencyStop();
      m_sip.flags = static_cast<std::uint16_t>((m_sip.flags & ~ArcosSip::kMotorsOn) |
                                               (on ? ArcosSip::kMotorsOn : 0));
    }
    else if (is(ArcosCommand::Vel)) {
      const auto speed = static_cast<std::int16_t>(arcosArgument(packet).value_or(0));
      m_sip.leftSpeed = m_sip.rightSpeed = speed;
    }
    else if (is(ArcosCommand::EStop)) {
      m_sip.leftSpeed = m_sip.rightSpeed = 0;
    }
  }

  int m_descriptor;
  speed_t m_speed; ///< B0: any
  std::string m_subclass;
  bool m_open;
  bool m_synced = false;
  bool m_silent = false;
  ArcosReader m_reader;
  std::vector<ArcosPacket> m_heard;
  ArcosSip m_sip;
  Time m_lastSip{};
};

} // namespace homeward
