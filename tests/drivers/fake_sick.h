// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/drivers/protocol/sick.h>

#include "fake_device.h"

#include <termios.h>
#include <vector>

namespace homeward
{

/** A LMS-200 behind a pseudo-terminal: deaf at the wrong speed, one scan every 20 ms. */
class FakeSick final : public FakeDevice
{
public:
  /** @param mode, unit what its memory holds */
  explicit FakeSick(int descriptor, std::uint8_t mode = 0, std::uint8_t unit = 0)
      : FakeDevice(descriptor), m_descriptor(descriptor), m_block{0, 0, 70, 0, 0, mode, unit, 0}
  {
    start();
  }
  ~FakeSick() override { stop(); }

  /** True when a telegram of the host that starts so came, or comes. */
  bool heard(const Bytes &start)
  {
    return eventually([&] { return hasHeard(start); });
  }

  /** True when such a telegram came; to be asked under the lock. */
  bool hasHeard(const Bytes &start) const
  {
    return std::any_of(m_heard.begin(), m_heard.end(), [&](const Bytes &payload) {
      return payload.size() >= start.size() &&
             std::equal(start.begin(), start.end(), payload.begin());
    });
  }

  void forget()
  {
    const std::lock_guard lock(m_mutex);
    m_heard.clear();
  }

  void refusePassword()
  {
    const std::lock_guard lock(m_mutex);
    m_passwordAnswer = 1;
  }

  void fallSilent()
  {
    const std::lock_guard lock(m_mutex);
    m_measuring = false;
  }

  speed_t speed() const { return m_speed; }      ///< to be asked under the lock
  const Bytes &block() const { return m_block; } ///< to be asked under the lock

private:
  static constexpr Duration kCycle = std::chrono::milliseconds(20);

  void serve(std::span<const std::uint8_t> bytes, Time now) override
  {
    termios line{};
    if (::tcgetattr(m_descriptor, &line) == 0 && ::cfgetospeed(&line) != m_speed) {
      return; // noise, as far as this device can tell
    }
    m_reader.push(bytes);
    while (const std::optional<SickTelegram> telegram = m_reader.next()) {
      m_heard.push_back(telegram->payload);
      obey(telegram->payload);
    }
    if (m_measuring && now - m_lastScan >= kCycle) {
      m_lastScan = now;
      SickScan scan{m_block[6] == 1 ? 0.001 : 0.01, true, {}, 0x10};
      for (std::size_t i = 0; i < m_counts; ++i) {
        scan.counts.push_back(static_cast<std::uint16_t>(1000 + i));
      }
      send(frameSick(encodeSickScan(scan)));
    }
  }

  void answer(Bytes payload)
  {
    payload.push_back(0x10);
    send(std::array{kSickAck});
    send(frameSick({kSickScanner, payload}));
  }

  void obey(const Bytes &payload)
  {
    switch (payload[0]) {
    case 0x20:
      setMode(payload.at(1));
      break;
    case 0x74: {
      Bytes config{0xF4};
      config.insert(config.end(), m_block.begin(), m_block.end());
      answer(config);
      break;
    }
    case 0x77:
      m_block.assign(payload.begin() + 1, payload.end());
      answer({0xF7, 0x01});
      break;
    case 0x3B:
      m_counts = payload.at(1) * 100U / payload.at(3) + 1U;
      answer({0xBB, 0x01, payload.at(1), 0, payload.at(3), 0});
      break;
    default:
      break;
    }
  }

  void setMode(std::uint8_t mode)
  {
    answer({0xA0, mode == 0 ? m_passwordAnswer : std::uint8_t{0}});
    m_measuring = mode == 0x24 || (m_measuring && mode != 0x25);
    if (mode == 0x40) {
      m_speed = B38400;
    }
  }

  int m_descriptor;
  Bytes m_block;
  speed_t m_speed = B9600;
  std::uint8_t m_passwordAnswer = 0;
  bool m_measuring = false;
  std::size_t m_counts = 181;
  SickReader m_reader;
  std::vector<Bytes> m_heard;
  Time m_lastScan{};
};

} // namespace homeward
