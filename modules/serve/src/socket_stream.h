// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <httplib.h>

#include <chrono>

namespace homeward
{

/** A connection on which a whole request must come within a time, byte by byte or not. */
class SocketStream final : public httplib::Stream
{
public:
  using Clock = std::chrono::steady_clock;

  /** @param patience for a request to come, and for each write to be taken */
  SocketStream(int socket, Clock::duration patience) : m_socket(socket), m_patience(patience) {}

  /** Waits for the next request, whose time then begins. @return false when none came */
  bool awaitRequest();

  bool is_readable() const override;
  bool is_writable() const override;
  ssize_t read(char *bytes, std::size_t size) override;
  ssize_t write(const char *bytes, std::size_t size) override;
  void get_remote_ip_and_port(std::string &ip, int &port) const override;
  void get_local_ip_and_port(std::string &ip, int &port) const override;
  int socket() const override { return m_socket; }

private:
  bool ready(short what, Clock::time_point until) const;

  int m_socket;
  Clock::duration m_patience;
  Clock::time_point m_due; ///< of the request
};

} // namespace homeward
