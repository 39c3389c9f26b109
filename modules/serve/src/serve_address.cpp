// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/serve/serve_address.h>

#include <homeward/core/error.h>

#include <charconv>

namespace homeward
{

bool ServeAddress::loopback() const
{
  return host == "localhost" || host == "::1" || host.rfind("127.", 0) == 0;
}

ServeAddress parseServeAddress(const std::string &text)
{
  ServeAddress address;
  const std::size_t colon = text.rfind(':');
  std::string port = text;
  if (colon != std::string::npos) {
    address.host = text.substr(0, colon);
    port = text.substr(colon + 1);
    if (address.host.size() > 2 && address.host.front() == '[' && address.host.back() == ']') {
      address.host = address.host.substr(1, address.host.size() - 2);
    }
  }
  const char *end = port.data() + port.size();
  const auto [last, error] = std::from_chars(port.data(), end, address.port);
  if (error != std::errc() || last != end || address.port < 0 || address.port > 65535 ||
      address.host.empty()) {
    throw ConfigError("'" + text + "' is no [HOST:]PORT, as 8080 or 192.168.1.5:8080");
  }
  return address;
}

} // namespace homeward
