// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/time.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace homeward
{

/** The speeds of serial lines, bits a second, the most usual ones of robots first. */
inline constexpr std::array kSerialBauds = {9600, 38400, 115200, 19200, 57600};

/**
 * Bytes to and from a device, over a socket or a serial line. One thread may read while another
 * writes.
 */
class ByteStream
{
public:
  virtual ~ByteStream() = default;

  /**
   * Waits for bytes, at most `timeout`.
   * @return how many came; 0 when none did in time
   * @throw DeviceError when the other side is gone
   */
  virtual std::size_t read(std::span<std::uint8_t> into, Duration timeout) = 0;

  /** Writes all bytes. @throw DeviceError when the other side is gone or takes none for 1 s */
  virtual void write(std::span<const std::uint8_t> bytes) = 0;

  /**
   * Changes the speed of a serial line; a socket has none and ignores it.
   * @param baud one of kSerialBauds @throw DeviceError otherwise
   */
  virtual void setBaud(int baud) = 0;
};

/** A stream over an open socket, pseudo-terminal or serial line, which it owns and closes. */
std::unique_ptr<ByteStream> streamOver(int descriptor, const std::string &name);

/** Connects to a TCP port. @throw DeviceError naming host, port and reason */
std::unique_ptr<ByteStream> connectTcp(const std::string &host, int port,
                                       Duration timeout = std::chrono::seconds(5));

/** Opens a serial line raw, 8N1. @throw DeviceError naming path and reason */
std::unique_ptr<ByteStream> openSerial(const std::string &path, int baud);

/** A TCP port of a host. */
struct TcpAddress
{
  std::string host; ///< name or address
  int port = 0;     ///< 1 to 65535
};

/**
 * What an address names.
 * @return nothing for the path of a serial line, which starts with a slash
 * @throw ConfigError when it is neither that nor `tcp:HOST:PORT`
 */
std::optional<TcpAddress> parseTcpAddress(const std::string &address);

/**
 * Opens what an address names: `tcp:HOST:PORT`, or the path of a serial line.
 * @throw ConfigError when it is neither; DeviceError when it does not open
 */
std::unique_ptr<ByteStream> openStream(const std::string &address, int baud);

} // namespace homeward
