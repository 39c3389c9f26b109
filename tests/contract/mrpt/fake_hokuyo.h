// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "../../drivers/fake_device.h"

#include <homeward/core/error.h>

#include <atomic>
#include <poll.h>
#include <string>
#include <vector>

namespace homeward
{

/**
 * A Hokuyo UTM-30LX on a TCP port, in SCIP 2.0: 270 degrees in quarters of a degree, forty scans a
 * second. Source: Hokuyo, Communication Protocol Specification for SCIP2.0 Standard (C-42-03320B).
 */
class FakeHokuyo
{
public:
  static constexpr int kLastStep = 1080;
  static constexpr int kFrontStep = 540;
  static constexpr int kStepsPerTurn = 1440;

  /** @param millimetres of every step */
  explicit FakeHokuyo(std::vector<int> millimetres) : m_millimetres(std::move(millimetres))
  {
    m_listener = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    EXPECT_EQ(::bind(m_listener, reinterpret_cast<sockaddr *>(&address), size), 0);
    EXPECT_EQ(::listen(m_listener, 1), 0);
    ::getsockname(m_listener, reinterpret_cast<sockaddr *>(&address), &size);
    m_address = "tcp:127.0.0.1:" + std::to_string(ntohs(address.sin_port));
    m_thread = std::jthread([this](const std::stop_token &stop) { run(stop); });
  }
  ~FakeHokuyo()
  {
    m_thread.request_stop();
    m_thread.join();
    ::close(m_listener);
  }
  FakeHokuyo(const FakeHokuyo &) = delete;
  FakeHokuyo &operator=(const FakeHokuyo &) = delete;

  const std::string &address() const { return m_address; }

  void fallSilent() { m_silent = true; }

private:
  void run(const std::stop_token &stop)
  {
    while (!stop.stop_requested()) {
      pollfd waiting{m_listener, POLLIN, 0};
      if (::poll(&waiting, 1, 20) > 0) {
        serve(*streamOver(::accept(m_listener, nullptr, nullptr), "host"), stop);
      }
    }
  }

  void serve(ByteStream &host, const std::stop_token &stop)
  {
    std::array<std::uint8_t, 256> buffer{};
    std::string heard;
    std::string measuring;
    try {
      while (!stop.stop_requested()) {
        const std::size_t count = host.read(buffer, std::chrono::milliseconds(25));
        heard.append(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(count));
        for (std::size_t end = heard.find('\n'); end != std::string::npos; end = heard.find('\n')) {
          const std::string command = heard.substr(0, end);
          heard.erase(0, end + 1);
          measuring = command.starts_with("MD") ? command : command == "QT" ? "" : measuring;
          say(host, answer(command));
        }
        if (!measuring.empty() && !m_silent) {
          say(host, scan(measuring));
        }
      }
    }
    catch (const DeviceError &) { // the host has hung up
    }
  }

  static void say(ByteStream &host, const std::string &text)
  {
    host.write(std::span(reinterpret_cast<const std::uint8_t *>(text.data()), text.size()));
  }

  /** A line with its sum. */
  static std::string line(const std::string &text)
  {
    unsigned sum = 0;
    for (const char letter : text) {
      sum += static_cast<unsigned char>(letter);
    }
    return text + static_cast<char>((sum & 0x3FU) + 0x30U) + "\n";
  }

  static std::string fact(const std::string &text)
  {
    const std::string sum = line(text);
    return text + ";" + sum.substr(sum.size() - 2);
  }

  static std::string answer(const std::string &command)
  {
    std::string facts;
    if (command == "PP") {
      facts = fact("MODL:UTM-30LX") + fact("DMIN:23") + fact("DMAX:60000") +
              fact("ARES:" + std::to_string(kStepsPerTurn)) + fact("AMIN:0") +
              fact("AMAX:" + std::to_string(kLastStep)) +
              fact("AFRT:" + std::to_string(kFrontStep)) + fact("SCAN:2400");
    }
    else if (command == "VV") {
      facts = fact("VEND:Homeward") + fact("PROD:emulator") + fact("FIRM:1") +
              fact("PROT:SCIP 2.0") + fact("SERI:1");
    }
    return command + "\n" + line("00") + facts + "\n";
  }

  /** Three letters of six bits for each range, in lines of 64. */
  std::string scan(const std::string &command) const
  {
    std::string data;
    for (const int range : m_millimetres) {
      for (const int shift : {12, 6, 0}) {
        data.push_back(static_cast<char>(((range >> shift) & 0x3F) + 0x30));
      }
    }
    std::string text = command + "\n" + line("99") + line("0000");
    for (std::size_t begin = 0; begin < data.size(); begin += 64) {
      text += line(data.substr(begin, 64));
    }
    return text + "\n";
  }

  std::vector<int> m_millimetres;
  int m_listener = -1;
  std::string m_address;
  std::atomic<bool> m_silent{false};
  std::jthread m_thread;
};

} // namespace homeward
