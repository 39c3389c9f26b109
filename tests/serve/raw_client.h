// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <arpa/inet.h>
#include <chrono>
#include <netinet/in.h>
#include <poll.h>
#include <string>
#include <sys/socket.h>
#include <unistd.h>

namespace homeward
{

/** A connection that sends what no browser would. */
class RawClient
{
public:
  explicit RawClient(int port) : m_socket(::socket(AF_INET, SOCK_STREAM, 0))
  {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    m_connected =
        ::connect(m_socket, reinterpret_cast<sockaddr *>(&address), sizeof address) == 0; // NOLINT
  }
  ~RawClient() { ::close(m_socket); }
  RawClient(const RawClient &) = delete;
  RawClient &operator=(const RawClient &) = delete;

  bool connected() const { return m_connected; }

  bool send(const std::string &text)
  {
    return ::send(m_socket, text.data(), text.size(), MSG_NOSIGNAL) ==
           static_cast<ssize_t>(text.size());
  }

  /** All that comes until `end` has come, the server closes or the time is over. */
  std::string receive(const std::string &end, double seconds = 3.0)
  {
    const auto due = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (m_text.find(end) == std::string::npos) {
      const std::chrono::duration<double, std::milli> left = due - std::chrono::steady_clock::now();
      pollfd asked{m_socket, POLLIN, 0};
      if (left.count() <= 0.0 || poll(&asked, 1, static_cast<int>(left.count()) + 1) <= 0) {
        break;
      }
      char bytes[4096];
      const ssize_t got = recv(m_socket, bytes, sizeof bytes, 0);
      if (got <= 0) {
        m_closed = true;
        break;
      }
      m_text.append(bytes, static_cast<std::size_t>(got));
    }
    return m_text;
  }

  /** Whether the server ended the connection. */
  bool closed() const { return m_closed; }

private:
  int m_socket;
  bool m_connected = false;
  bool m_closed = false;
  std::string m_text;
};

/** The status that a request is answered with; 0: none, the connection was closed or kept mute. */
inline int statusOf(int port, const std::string &request, double seconds = 3.0)
{
  RawClient client(port);
  client.send(request);
  const std::string text = client.receive("\r\n", seconds);
  return text.rfind("HTTP/1.1 ", 0) == 0 ? std::stoi(text.substr(9, 3)) : 0;
}

} // namespace homeward
