// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace homeward
{

/** Where a server listens. */
struct ServeAddress
{
  std::string host = "127.0.0.1"; ///< address or name
  int port = 0;                   ///< 0: any that is free

  /** Whether only this computer can come there. */
  bool loopback() const;
};

/** Reads `[HOST:]PORT`; HOST in brackets where it is an IPv6 address. @throw ConfigError */
ServeAddress parseServeAddress(const std::string &text);

} // namespace homeward
