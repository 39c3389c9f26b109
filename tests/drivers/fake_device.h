// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/drivers/byte_stream.h>
#include <homeward/drivers/steady_clock.h>

#include <arpa/inet.h>
#include <array>
#include <condition_variable>
#include <functional>
#include <gtest/gtest.h>
#include <memory>
#include <mutex>
#include <netinet/in.h>
#include <pty.h>
#include <string>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>
#include <utility>

namespace homeward
{

/** How long a test waits for what must come; reached only when it fails. */
inline constexpr std::chrono::seconds kPatience{10};

/** The two ends of a line: the driver's stream and the device's descriptor. */
struct Line
{
  std::unique_ptr<ByteStream> driver;
  int device = -1;
};

/** A real TCP connection on the loopback interface. */
inline Line tcpLine()
{
  const int listener = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  EXPECT_EQ(::bind(listener, reinterpret_cast<sockaddr *>(&address), size), 0);
  EXPECT_EQ(::listen(listener, 1), 0);
  ::getsockname(listener, reinterpret_cast<sockaddr *>(&address), &size);
  Line line;
  line.driver = openStream("tcp:127.0.0.1:" + std::to_string(ntohs(address.sin_port)), 9600);
  line.device = ::accept(listener, nullptr, nullptr);
  ::close(listener);
  return line;
}

/** A real pseudo-terminal. */
inline Line serialLine(int baud = 9600)
{
  int device = -1;
  int terminal = -1;
  std::array<char, 128> path{};
  EXPECT_EQ(::openpty(&device, &terminal, path.data(), nullptr, nullptr), 0);
  Line line{openStream(path.data(), baud), device};
  ::close(terminal);
  return line;
}

/** A device that answers on its own thread until it is destroyed. */
class FakeDevice
{
public:
  FakeDevice(const FakeDevice &) = delete;
  FakeDevice &operator=(const FakeDevice &) = delete;

  /** Waits until `condition`, read under the device's lock, holds. */
  bool eventually(const std::function<bool()> &condition)
  {
    std::unique_lock lock(m_mutex);
    return m_changed.wait_for(lock, kPatience, condition);
  }

  /** Hangs up. */
  void hangUp() { stop(); }

protected:
  explicit FakeDevice(int descriptor) : m_stream(streamOver(descriptor, "device")) {}
  virtual ~FakeDevice() { stop(); }

  /** To be called at the end of the constructor, stop() at the start of the destructor. */
  void start()
  {
    m_thread = std::jthread([this](const std::stop_token &token) { run(token); });
  }

  void stop()
  {
    m_thread.request_stop();
    if (m_thread.joinable()) {
      m_thread.join();
    }
    m_stream.reset();
  }

  /** Bytes came (or none in time); called under the lock. */
  virtual void serve(std::span<const std::uint8_t> bytes, Time now) = 0;

  void send(std::span<const std::uint8_t> bytes) { m_stream->write(bytes); }

  std::mutex m_mutex;

private:
  void run(const std::stop_token &token)
  {
    std::array<std::uint8_t, 512> buffer{};
    const SteadyClock clock;
    try {
      while (!token.stop_requested()) {
        const std::size_t count = m_stream->read(buffer, std::chrono::milliseconds(5));
        const std::lock_guard lock(m_mutex);
        serve(std::span(buffer).first(count), clock.now());
        m_changed.notify_all();
      }
    }
    catch (const std::exception &) { // the driver has hung up
    }
  }

  std::unique_ptr<ByteStream> m_stream;
  std::condition_variable m_changed;
  std::jthread m_thread;
};

/** Calls until `attempt` is true, a millisecond apart; false when patience ends. */
inline bool soon(const std::function<bool()> &attempt)
{
  SteadyClock clock;
  const Time deadline = clock.now() + kPatience;
  while (clock.now() < deadline) {
    if (attempt()) {
      return true;
    }
    clock.sleepUntil(clock.now() + std::chrono::milliseconds(1));
  }
  return false;
}

} // namespace homeward
