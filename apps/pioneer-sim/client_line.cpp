// SPDX-License-Identifier: GPL-3.0-or-later
#include "client_line.h"

#include <homeward/core/error.h>

#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <cerrno>
#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <pty.h>
#include <sys/socket.h>
#include <system_error>
#include <termios.h>
#include <unistd.h>
#include <utility>

namespace homeward
{
namespace
{

constexpr std::size_t kOutboxLimit = 65536;   ///< bytes kept for a slow client
constexpr std::chrono::seconds kPatience{10}; ///< with one that takes none

std::string reason()
{
  return std::generic_category().message(errno);
}

void setNonBlocking(int descriptor)
{
  ::fcntl(descriptor, F_SETFL, ::fcntl(descriptor, F_GETFL) | O_NONBLOCK);
}

bool wouldBlock()
{
  return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR;
}

} // namespace

TcpLine::TcpLine(const std::string &host, int port)
{
  const std::string name = host + ":" + std::to_string(port);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  if (::inet_pton(AF_INET, host.c_str(), &address.sin_addr) != 1) {
    throw ConfigError("address '" + host + "' is not an IPv4 address such as 127.0.0.1");
  }
  m_listener = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  const int on = 1;
  ::setsockopt(m_listener, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  socklen_t size = sizeof address;
  auto *const generic = reinterpret_cast<sockaddr *>(&address);
  if (m_listener < 0 || ::bind(m_listener, generic, size) != 0 || ::listen(m_listener, 8) != 0 ||
      ::getsockname(m_listener, generic, &size) != 0) {
    const std::string why = reason();
    ::close(m_listener);
    throw DeviceError("cannot listen on " + name + ": " + why + "; choose another port, or 0");
  }
  m_port = ntohs(address.sin_port);
}

TcpLine::~TcpLine()
{
  hangUp();
  ::close(m_listener);
}

void TcpLine::watch(std::vector<pollfd> &waiting) const
{
  const auto events = static_cast<short>(POLLIN | (m_outbox.empty() ? 0 : POLLOUT));
  waiting.push_back(m_client >= 0 ? pollfd{m_client, events, 0} : pollfd{m_listener, POLLIN, 0});
}

Arrival TcpLine::receive()
{
  Arrival arrival;
  if (m_client < 0) {
    m_client = ::accept4(m_listener, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
    if (m_client >= 0) {
      const int on = 1;
      ::setsockopt(m_client, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
      m_lastTaken = std::chrono::steady_clock::now();
    }
  }
  std::array<std::uint8_t, 4096> buffer{};
  while (m_client >= 0) {
    const ssize_t count = ::recv(m_client, buffer.data(), buffer.size(), 0);
    if (count <= 0) {
      if (count == 0 || !wouldBlock()) {
        hangUp();
      }
      break;
    }
    arrival.bytes.insert(arrival.bytes.end(), buffer.begin(), buffer.begin() + count);
  }
  flush();
  arrival.left = std::exchange(m_left, false);
  return arrival;
}

void TcpLine::send(std::span<const std::uint8_t> packet)
{
  if (m_client < 0 || m_outbox.size() + packet.size() > kOutboxLimit) {
    return;
  }
  m_outbox.insert(m_outbox.end(), packet.begin(), packet.end());
  flush();
}

void TcpLine::flush()
{
  const auto now = std::chrono::steady_clock::now();
  if (m_client < 0 || m_outbox.empty()) {
    m_lastTaken = now;
    return;
  }
  const ssize_t count = ::send(m_client, m_outbox.data(), m_outbox.size(), MSG_NOSIGNAL);
  if (count > 0) {
    m_outbox.erase(m_outbox.begin(), m_outbox.begin() + count);
    m_lastTaken = now;
  }
  else if ((count < 0 && !wouldBlock()) || now - m_lastTaken > kPatience) {
    hangUp();
  }
}

void TcpLine::hangUp()
{
  if (m_client >= 0) {
    ::close(m_client);
    m_client = -1;
    m_left = true;
  }
  m_outbox.clear();
}

PtyLine::PtyLine()
{
  std::array<char, 128> path{};
  if (::openpty(&m_device, &m_terminal, path.data(), nullptr, nullptr) != 0) {
    throw DeviceError("cannot open a pseudo-terminal: " + reason());
  }
  m_path = path.data();
  setNonBlocking(m_device);
  for (const int descriptor : {m_device, m_terminal}) {
    ::fcntl(descriptor, F_SETFD, FD_CLOEXEC);
  }
  termios raw{};
  ::tcgetattr(m_terminal, &raw);
  ::cfmakeraw(&raw); // or it would echo every packet to its sender
  ::cfsetspeed(&raw, B9600);
  ::tcsetattr(m_terminal, TCSANOW, &raw);
}

PtyLine::~PtyLine()
{
  ::close(m_device);
  ::close(m_terminal);
}

int PtyLine::baud() const
{
  termios line{};
  if (::tcgetattr(m_terminal, &line) != 0) {
    return 0;
  }
  switch (::cfgetospeed(&line)) {
  case B9600:
    return 9600;
  case B19200:
    return 19200;
  case B38400:
    return 38400;
  case B57600:
    return 57600;
  case B115200:
    return 115200;
  default:
    return 0;
  }
}

void PtyLine::watch(std::vector<pollfd> &waiting) const
{
  waiting.push_back({m_device, POLLIN, 0});
}

Arrival PtyLine::receive()
{
  Arrival arrival;
  std::array<std::uint8_t, 4096> buffer{};
  for (;;) {
    const ssize_t count = ::read(m_device, buffer.data(), buffer.size());
    if (count <= 0) {
      return arrival;
    }
    arrival.bytes.insert(arrival.bytes.end(), buffer.begin(), buffer.begin() + count);
  }
}

void PtyLine::send(std::span<const std::uint8_t> packet)
{
  const ssize_t count = ::write(m_device, packet.data(), packet.size());
  if (count < static_cast<ssize_t>(packet.size())) {
    ::tcflush(m_terminal, TCIFLUSH);
  }
}

} // namespace homeward
