// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/drivers/protocol/arcos.h>

#include <chrono>
#include <poll.h>
#include <span>
#include <string>
#include <vector>

namespace homeward
{

/** What came over a line since it was asked last. */
struct Arrival
{
  Bytes bytes;
  bool left = false; ///< the client has hung up, after these bytes
};

/** The device's end of a line to which clients come and from which they go. Never blocks. */
class ClientLine
{
public:
  virtual ~ClientLine() = default;

  /** Adds what is to be waited for. */
  virtual void watch(std::vector<pollfd> &waiting) const = 0;

  virtual Arrival receive() = 0;

  /** Sends a packet whole or, when the client is too slow to take it, not at all. */
  virtual void send(std::span<const std::uint8_t> packet) = 0;
};

/** A TCP port. One client is served at a time; the next waits until it has left. */
class TcpLine final : public ClientLine
{
public:
  /** @param port 0 lets the system choose @throw DeviceError naming address and reason */
  TcpLine(const std::string &host, int port);
  ~TcpLine() override;
  TcpLine(const TcpLine &) = delete;
  TcpLine &operator=(const TcpLine &) = delete;

  int port() const { return m_port; }

  void watch(std::vector<pollfd> &waiting) const override;
  Arrival receive() override;
  void send(std::span<const std::uint8_t> packet) override;

private:
  void flush();
  void hangUp();

  int m_listener = -1;
  int m_client = -1;
  int m_port = 0;
  Bytes m_outbox; ///< accepted, not yet taken by the client
  std::chrono::steady_clock::time_point m_lastTaken;
  bool m_left = false;
};

/** A pseudo-terminal. Nobody can tell who is at its other end, or whether anybody is. */
class PtyLine final : public ClientLine
{
public:
  /** @throw DeviceError when the system gives none */
  PtyLine();
  ~PtyLine() override;
  PtyLine(const PtyLine &) = delete;
  PtyLine &operator=(const PtyLine &) = delete;

  /** What a client opens: /dev/pts/N. */
  const std::string &path() const { return m_path; }

  /** The speed that the client has set, bits a second; 0 when it is unusual. */
  int baud() const;

  void watch(std::vector<pollfd> &waiting) const override;
  Arrival receive() override;
  /** A client that does not read loses what has piled up, as on a serial line. */
  void send(std::span<const std::uint8_t> packet) override;

private:
  int m_device = -1;
  int m_terminal = -1; ///< kept open, so that a client may come and go
  std::string m_path;
};

} // namespace homeward
