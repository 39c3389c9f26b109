// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/drivers/protocol/cola.h>

#include "fake_device.h"

#include <algorithm>
#include <string>
#include <vector>

namespace homeward
{

/** A LMS1xx behind a TCP connection: needs a login, warms up, one scan every 20 ms when asked to.
 */
class FakeLms1xx final : public FakeDevice
{
public:
  /** @param scan what it measures, over and over */
  explicit FakeLms1xx(int descriptor, ColaScan scan)
      : FakeDevice(descriptor), m_scan(std::move(scan))
  {
    start();
  }
  ~FakeLms1xx() override { stop(); }

  /** True when a telegram that starts so came, or comes. */
  bool heard(const std::string &start)
  {
    return eventually([&] {
      return std::any_of(m_heard.begin(), m_heard.end(),
                         [&](const std::string &text) { return text.starts_with(start); });
    });
  }

  void refuse(const std::string &start)
  {
    const std::lock_guard lock(m_mutex);
    m_refused = start;
  }

  void fallSilent()
  {
    const std::lock_guard lock(m_mutex);
    m_measuring = false;
  }

private:
  static constexpr Duration kCycle = std::chrono::milliseconds(20);

  void serve(std::span<const std::uint8_t> bytes, Time now) override
  {
    m_reader.push(bytes);
    while (const std::optional<std::string> telegram = m_reader.next()) {
      m_heard.push_back(*telegram);
      say(answer(*telegram));
    }
    if (m_measuring && now - m_lastScan >= kCycle) {
      m_lastScan = now;
      say(encodeColaScan(m_scan));
    }
  }

  void say(const std::string &telegram) { send(frameCola(telegram)); }

  std::string answer(const std::string &telegram)
  {
    if (!m_refused.empty() && telegram.starts_with(m_refused)) {
      return "sFA 3";
    }
    if (telegram == "sMN SetAccessMode 03 F4724744") {
      m_authorised = true;
      return "sAN SetAccessMode 1";
    }
    if (telegram.starts_with("sMN mLMPsetscancfg ")) {
      return m_authorised ? "sAN mLMPsetscancfg 0 1388 1 1388 FFF92230 225510" : "sFA 3";
    }
    if (telegram.starts_with("sWN LMDscandatacfg ")) {
      return m_authorised ? "sWA LMDscandatacfg" : "sFA 3";
    }
    if (telegram == "sMN Run") {
      return "sAN Run 1";
    }
    if (telegram == "sRN STlms") {
      return m_warmUp-- > 0 ? "sRA STlms 4 0 8 15:24:25 8 08.08.13 0 0 0"
                            : "sRA STlms 7 0 8 15:24:25 8 08.08.13 0 0 0";
    }
    if (telegram.starts_with("sEN LMDscandata ")) {
      m_measuring = telegram.ends_with('1');
      return "sEA LMDscandata " + telegram.substr(telegram.size() - 1);
    }
    return "sFA 1";
  }

  ColaScan m_scan;
  std::string m_refused;
  bool m_authorised = false;
  int m_warmUp = 1;
  bool m_measuring = false;
  ColaReader m_reader;
  std::vector<std::string> m_heard;
  Time m_lastScan{};
};

} // namespace homeward
