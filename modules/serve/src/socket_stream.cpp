// SPDX-License-Identifier: GPL-3.0-or-later
#include "socket_stream.h"

#include <algorithm>

#include <cerrno>
#include <poll.h>
#include <sys/socket.h>

namespace homeward
{

bool SocketStream::ready(short what, Clock::time_point until) const
{
  while (true) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now()).count();
    pollfd asked{m_socket, what, 0};
    const int count = poll(&asked, 1, static_cast<int>(std::max<std::int64_t>(left, 0)));
    if (count >= 0 || errno != EINTR) {
      return count > 0 && (asked.revents & what) != 0;
    }
  }
}

bool SocketStream::awaitRequest()
{
  if (!ready(POLLIN, Clock::now() + m_patience)) {
    return false;
  }
  m_due = Clock::now() + m_patience;
  return true;
}

bool SocketStream::is_readable() const
{
  return ready(POLLIN, m_due);
}

bool SocketStream::is_writable() const
{
  char byte = 0;
  const bool left = ready(POLLIN, Clock::now()) && recv(m_socket, &byte, 1, MSG_PEEK) <= 0;
  return !left && ready(POLLOUT, Clock::now() + m_patience);
}

ssize_t SocketStream::read(char *bytes, std::size_t size)
{
  return is_readable() ? recv(m_socket, bytes, size, 0) : -1;
}

ssize_t SocketStream::write(const char *bytes, std::size_t size)
{
  if (!ready(POLLOUT, Clock::now() + m_patience)) {
    return -1;
  }
  return send(m_socket, bytes, size, MSG_NOSIGNAL | MSG_DONTWAIT);
}

void SocketStream::get_remote_ip_and_port(std::string &ip, int &port) const
{
  ip.clear(); // nobody asks
  port = 0;
}

void SocketStream::get_local_ip_and_port(std::string &ip, int &port) const
{
  ip.clear();
  port = 0;
}

} // namespace homeward
