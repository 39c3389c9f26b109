// SPDX-License-Identifier: GPL-3.0-or-later
#include "operator_input.h"

#include "stop_signal.h"

#include <homeward/core/error.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <linux/joystick.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <system_error>
#include <unistd.h>

namespace homeward
{
namespace
{

constexpr char kControlZ = 0x1A;

void stopBecause(const std::string &reason)
{
  askToStop(); // before anything else
  std::fprintf(stderr, "stopping: %s\n", reason.c_str());
}

int openJoystick(const std::string &path)
{
  if (path.empty()) {
    return -1;
  }
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) {
    throw DeviceError(path +
                      ": cannot open the joystick: " + std::generic_category().message(errno) +
                      "; is it plugged in and may this user use it?");
  }
  return descriptor;
}

/** What has come; nothing where the other side is gone. */
template <std::size_t size> ssize_t readNow(int descriptor, std::array<char, size> &buffer)
{
  const ssize_t count = ::read(descriptor, buffer.data(), buffer.size());
  const bool later = count < 0 && (errno == EAGAIN || errno == EINTR);
  return later ? 0 : (count == 0 ? -1 : count);
}

} // namespace

OperatorInput::OperatorInput(const std::string &joystick)
    : m_stop(stopSignal()), m_joystick(openJoystick(joystick)), m_end(::eventfd(0, EFD_CLOEXEC)),
      m_thread([this] { listen(); })
{}

OperatorInput::~OperatorInput()
{
  ::eventfd_write(m_end, 1);
  m_thread.join();
  ::close(m_end);
  if (m_joystick >= 0) {
    ::close(m_joystick);
  }
}

bool OperatorInput::awaitGo()
{
  m_go = false; // pressed before, it was for something else
  while (!m_go && !m_stop) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return !m_stop;
}

void OperatorInput::listen()
{
  std::array<pollfd, 3> waiting{pollfd{m_end, POLLIN, 0},
                                pollfd{hasKeys() ? STDIN_FILENO : -1, POLLIN, 0},
                                pollfd{m_joystick, POLLIN, 0}};
  while (waiting[0].revents == 0) {
    if (::poll(waiting.data(), waiting.size(), -1) < 0) {
      waiting[0].revents = 0; // a signal came
      continue;
    }
    if (waiting[1].revents != 0 && !hearKeys()) {
      waiting[1].fd = -1;
      stopBecause("the terminal is gone");
    }
    if (waiting[2].revents != 0 && !hearJoystick()) {
      waiting[2].fd = -1;
      stopBecause("the joystick is gone");
    }
  }
}

/** @return false when there are no keys any more */
bool OperatorInput::hearKeys()
{
  std::array<char, 64> keys{};
  const ssize_t count = readNow(STDIN_FILENO, keys);
  for (ssize_t i = 0; i < count; ++i) {
    const char key = keys[static_cast<std::size_t>(i)];
    if (key == 's' || key == 'S' || key == ' ' || key == kControlZ) {
      stopBecause("a key");
    }
    m_go = m_go || key == 'g' || key == 'G';
  }
  return count >= 0;
}

/** @return false when there is no joystick any more */
bool OperatorInput::hearJoystick()
{
  std::array<char, 64 * sizeof(js_event)> bytes{};
  const ssize_t count = readNow(m_joystick, bytes);
  if (count < 0) {
    return false;
  }
  m_part.insert(m_part.end(), bytes.begin(), bytes.begin() + count);
  std::size_t at = 0;
  for (; at + sizeof(js_event) <= m_part.size(); at += sizeof(js_event)) {
    js_event event{};
    std::memcpy(&event, m_part.data() + at, sizeof event);
    if ((event.type & ~JS_EVENT_INIT) == JS_EVENT_BUTTON && event.value != 0) {
      stopBecause("button " + std::to_string(event.number) + " of the joystick");
    }
  }
  m_part.erase(m_part.begin(), m_part.begin() + static_cast<std::ptrdiff_t>(at));
  return true;
}

} // namespace homeward
