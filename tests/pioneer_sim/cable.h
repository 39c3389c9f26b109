// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <atomic>
#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <stdexcept>
#include <string>
#include <termios.h>
#include <thread>
#include <unistd.h>

namespace homeward
{

/** A serial cable to a device, with an adapter at the driver's end; either plug can be pulled. */
class Cable
{
public:
  /** @param device path of the device's line */
  explicit Cable(const std::string &device)
      : m_device(::open(device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC))
  {
    std::array<char, 128> path{};
    int terminal = -1;
    if (m_device < 0 || ::openpty(&m_adapter, &terminal, path.data(), nullptr, nullptr) != 0) {
      throw std::runtime_error("no cable to " + device);
    }
    m_path = path.data();
    termios raw{};
    ::tcgetattr(terminal, &raw);
    ::cfmakeraw(&raw);
    ::tcsetattr(terminal, TCSANOW, &raw);
    m_terminal = terminal;
    m_thread = std::jthread([this](const std::stop_token &stop) { carry(stop); });
  }

  ~Cable() { pullTheAdapter(); }
  Cable(const Cable &) = delete;
  Cable &operator=(const Cable &) = delete;

  /** What a driver opens. */
  const std::string &path() const { return m_path; }

  /** At the device: nothing passes any more, and nobody is told. */
  void pullAtTheDevice() { m_whole = false; }

  /** Out of the computer: the driver's line is gone. */
  void pullTheAdapter()
  {
    m_thread.request_stop();
    if (m_thread.joinable()) {
      m_thread.join();
      ::close(m_terminal);
      ::close(m_adapter);
      ::close(m_device);
    }
  }

private:
  void carry(const std::stop_token &stop)
  {
    while (!stop.stop_requested()) {
      std::array<pollfd, 2> ends{{{m_adapter, POLLIN, 0}, {m_device, POLLIN, 0}}};
      ::poll(ends.data(), ends.size(), 5);
      if ((ends[0].revents & POLLIN) != 0) {
        followSpeed();
        pass(m_adapter, m_device);
      }
      if ((ends[1].revents & POLLIN) != 0) {
        pass(m_device, m_adapter);
      }
    }
  }

  void pass(int from, int to) const
  {
    std::array<char, 1024> bytes{};
    const ssize_t count = ::read(from, bytes.data(), bytes.size());
    if (count > 0 && m_whole && ::write(to, bytes.data(), static_cast<std::size_t>(count)) < 0) {
      throw std::runtime_error("the device takes no bytes");
    }
  }

  /** The line to the device runs at the speed that the driver has set. */
  void followSpeed() const
  {
    termios driver{};
    termios device{};
    ::tcgetattr(m_terminal, &driver);
    ::tcgetattr(m_device, &device);
    if (::cfgetospeed(&driver) != ::cfgetospeed(&device)) {
      ::cfsetspeed(&device, ::cfgetospeed(&driver));
      ::tcsetattr(m_device, TCSANOW, &device);
    }
  }

  int m_device = -1;
  int m_adapter = -1;
  int m_terminal = -1; ///< kept open until the plug is pulled, so that a driver may come and go
  std::string m_path;
  std::atomic<bool> m_whole{true};
  std::jthread m_thread;
};

} // namespace homeward
