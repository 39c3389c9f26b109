// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/serve/page_server.h>

#include <chrono>
#include <map>
#include <mutex>

namespace homeward
{

/** Where a request says that it comes from and goes to. */
struct Visitor
{
  std::string host;   ///< header Host
  std::string origin; ///< header Origin; empty: there was none
  std::string token;  ///< empty: there was none
};

/** A command, and who gave it. */
struct Order
{
  std::string client;
  std::int64_t sequence = 0;
  bool take = false; ///< the client wants to command from now on
  PageCommand command;
};

/** Reads an order. @throw PageAnswer that says what is wrong */
Order parseOrder(const std::string &body);

/** Who may come in. Every answer that it gives is a refusal. For any number of threads. */
class Gate
{
public:
  using Clock = std::chrono::steady_clock;

  Gate(const PageServerOptions &options, int port);

  /** Whether a request for a page or for what the token guards may come. */
  std::optional<PageAnswer> refuseGet(const Visitor &visitor, bool guarded) const;

  /** Whether an order may; it then counts. */
  std::optional<PageAnswer> refuseOrder(const Visitor &visitor, const Order &order,
                                        Clock::time_point now);

  /** The client that commands; empty: nobody. */
  std::string commander() const;

  /** A client has gone. @return whether it was the one that commands */
  bool leave(const std::string &client);

private:
  bool knowsHost(const std::string &host) const;
  bool hasToken(const Visitor &visitor) const;
  bool tooMany(Clock::time_point now);
  bool seenBefore(const Order &order);

  ServeAddress m_address; ///< with the port that it got
  std::string m_token;
  std::set<std::string> m_free;
  double m_perSecond;
  mutable std::mutex m_mutex;
  double m_allowance; ///< commands, under the mutex as all below
  Clock::time_point m_last{};
  std::map<std::string, std::int64_t> m_sequences; ///< of each client the last
  std::string m_commander;
};

} // namespace homeward
