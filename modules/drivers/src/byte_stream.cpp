// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/error.h>
#include <homeward/drivers/byte_stream.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

namespace homeward
{
namespace
{

constexpr Duration kWriteTimeout = std::chrono::seconds(1);

std::string reason(int error)
{
  return std::generic_category().message(error);
}

/** True when `events` came within `timeout`; an interruption counts as none. */
bool wait(int descriptor, short events, Duration timeout)
{
  pollfd waiting{descriptor, events, 0};
  const auto whole = std::chrono::ceil<std::chrono::milliseconds>(timeout);
  return ::poll(&waiting, 1, static_cast<int>(whole.count())) > 0;
}

bool wouldBlock(int error)
{
  return error == EAGAIN || error == EWOULDBLOCK || error == EINTR;
}

speed_t speedOf(int baud, const std::string &name)
{
  switch (baud) {
  case 9600:
    return B9600;
  case 19200:
    return B19200;
  case 38400:
    return B38400;
  case 57600:
    return B57600;
  case 115200:
    return B115200;
  default:
    throw DeviceError(name + ": cannot run at " + std::to_string(baud) + " baud");
  }
}

class DescriptorStream final : public ByteStream
{
public:
  DescriptorStream(int descriptor, std::string name)
      : m_descriptor(descriptor), m_name(std::move(name))
  {
    struct stat status
    {};
    m_socket = ::fstat(m_descriptor, &status) == 0 && S_ISSOCK(status.st_mode);
    ::fcntl(m_descriptor, F_SETFL, ::fcntl(m_descriptor, F_GETFL) | O_NONBLOCK);
  }
  ~DescriptorStream() override { ::close(m_descriptor); }
  DescriptorStream(const DescriptorStream &) = delete;
  DescriptorStream &operator=(const DescriptorStream &) = delete;

  std::size_t read(std::span<std::uint8_t> into, Duration timeout) override
  {
    if (into.empty() || !wait(m_descriptor, POLLIN, timeout)) {
      return 0;
    }
    const ssize_t count = ::read(m_descriptor, into.data(), into.size());
    if (count > 0) {
      return static_cast<std::size_t>(count);
    }
    if (count < 0 && wouldBlock(errno)) {
      return 0;
    }
    throw DeviceError(m_name + ": the other side is gone" +
                      (count < 0 ? " (" + reason(errno) + ")" : ""));
  }

  void write(std::span<const std::uint8_t> bytes) override
  {
    while (!bytes.empty()) {
      if (!wait(m_descriptor, POLLOUT, kWriteTimeout)) {
        throw DeviceError(m_name + ": takes no bytes");
      }
      const ssize_t count = m_socket
                                ? ::send(m_descriptor, bytes.data(), bytes.size(), MSG_NOSIGNAL)
                                : ::write(m_descriptor, bytes.data(), bytes.size());
      if (count < 0 && !wouldBlock(errno)) {
        throw DeviceError(m_name + ": cannot write: " + reason(errno));
      }
      bytes = bytes.subspan(count > 0 ? static_cast<std::size_t>(count) : 0);
    }
  }

  void setBaud(int baud) override
  {
    const speed_t speed = speedOf(baud, m_name);
    termios line{};
    if (::tcgetattr(m_descriptor, &line) != 0) {
      return; // no terminal, so no speed
    }
    ::cfmakeraw(&line);
    line.c_cflag |= CLOCAL | CREAD;
    if (::cfsetspeed(&line, speed) != 0 || ::tcsetattr(m_descriptor, TCSADRAIN, &line) != 0) {
      throw DeviceError(m_name + ": cannot set " + std::to_string(baud) +
                        " baud: " + reason(errno));
    }
  }

private:
  int m_descriptor;
  std::string m_name;
  bool m_socket = false;
};

/** Connects, within `timeout`. @return 0 or the error number */
int connectWithin(int descriptor, const addrinfo &address, Duration timeout)
{
  ::fcntl(descriptor, F_SETFL, O_NONBLOCK);
  if (::connect(descriptor, address.ai_addr, address.ai_addrlen) == 0) {
    return 0;
  }
  if (errno != EINPROGRESS) {
    return errno;
  }
  if (!wait(descriptor, POLLOUT, timeout)) {
    return ETIMEDOUT;
  }
  int error = 0;
  socklen_t size = sizeof error;
  ::getsockopt(descriptor, SOL_SOCKET, SO_ERROR, &error, &size);
  return error;
}

} // namespace

std::unique_ptr<ByteStream> streamOver(int descriptor, const std::string &name)
{
  return std::make_unique<DescriptorStream>(descriptor, name);
}

std::unique_ptr<ByteStream> connectTcp(const std::string &host, int port, Duration timeout)
{
  const std::string name = host + ":" + std::to_string(port);
  addrinfo hints{};
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = SOCK_STREAM;
  addrinfo *found = nullptr;
  const int failure = ::getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &found);
  if (failure != 0) {
    throw DeviceError(name + ": no such host: " + ::gai_strerror(failure));
  }
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> addresses(found, &::freeaddrinfo);
  int error = EHOSTUNREACH;
  for (const addrinfo *address = found; address != nullptr; address = address->ai_next) {
    const int descriptor = ::socket(address->ai_family, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (descriptor < 0) {
      error = errno;
      continue;
    }
    error = connectWithin(descriptor, *address, timeout);
    if (error == 0) {
      const int on = 1;
      ::setsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
      return streamOver(descriptor, name);
    }
    ::close(descriptor);
  }
  throw DeviceError(name + ": cannot connect: " + reason(error) +
                    "; is the robot on and the port right?");
}

std::unique_ptr<ByteStream> openSerial(const std::string &path, int baud)
{
  const int descriptor = ::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) {
    throw DeviceError(path + ": cannot open: " + reason(errno) +
                      "; is it plugged in and may this user use it?");
  }
  std::unique_ptr<ByteStream> stream = streamOver(descriptor, path);
  if (::isatty(descriptor) == 0) {
    throw DeviceError(path + ": not a serial line");
  }
  stream->setBaud(baud);
  return stream;
}

std::optional<TcpAddress> parseTcpAddress(const std::string &address)
{
  if (address.starts_with('/')) {
    return std::nullopt;
  }
  constexpr std::string_view kTcp = "tcp:";
  const std::size_t colon = address.rfind(':');
  if (address.starts_with(kTcp) && colon > kTcp.size()) {
    int port = 0;
    const char *end = address.data() + address.size();
    const auto parsed = std::from_chars(address.data() + colon + 1, end, port);
    if (parsed.ec == std::errc() && parsed.ptr == end && port > 0 && port < 65536) {
      return TcpAddress{address.substr(kTcp.size(), colon - kTcp.size()), port};
    }
  }
  throw ConfigError("address '" + address +
                    "': 'tcp:HOST:PORT' or the path of a serial line is expected");
}

std::unique_ptr<ByteStream> openStream(const std::string &address, int baud)
{
  const std::optional<TcpAddress> tcp = parseTcpAddress(address);
  return tcp ? connectTcp(tcp->host, tcp->port) : openSerial(address, baud);
}

} // namespace homeward
