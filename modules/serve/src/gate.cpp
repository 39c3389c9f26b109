// SPDX-License-Identifier: GPL-3.0-or-later
#include "gate.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <cctype>
#include <unistd.h>

namespace homeward
{
namespace
{

constexpr std::size_t kMostClients = 1000; ///< whose numbers are known
constexpr std::size_t kLongestName = 64;

bool isAddress(const std::string &host)
{
  std::array<unsigned char, 16> bytes{};
  return inet_pton(AF_INET, host.c_str(), bytes.data()) == 1 ||
         inet_pton(AF_INET6, host.c_str(), bytes.data()) == 1;
}

bool isComputersName(const std::string &host)
{
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 &&
         (host == name.data() || host == std::string(name.data()) + ".local");
}

bool isWord(const std::string &text)
{
  return !text.empty() && text.size() <= kLongestName &&
         std::all_of(text.begin(), text.end(),
                     [](unsigned char c) { return std::isalnum(c) != 0 || c == '-'; });
}

/** As long for a wrong guess as for another one. */
bool equal(const std::string &a, const std::string &b)
{
  unsigned different = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    different |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
  }
  return different == 0;
}

} // namespace

Order parseOrder(const std::string &body)
{
  const PageAnswer wrong{400, "that is no command"};
  const nlohmann::json json = nlohmann::json::parse(body, nullptr, false);
  const auto has = [&](const char *key, auto type) { return (json[key].*type)(); };
  if (!json.is_object() || !json.contains("client") || !json.contains("sequence") ||
      !json.contains("command") || !has("client", &nlohmann::json::is_string) ||
      !has("sequence", &nlohmann::json::is_number_unsigned) ||
      !has("command", &nlohmann::json::is_string)) {
    throw wrong;
  }
  const nlohmann::json arguments = json.value("arguments", nlohmann::json::object());
  const nlohmann::json take = json.value("take", nlohmann::json(false));
  Order order{json["client"],
              json["sequence"],
              take.is_boolean() && take.get<bool>(),
              {json["command"], arguments.dump()}};
  if (!arguments.is_object() || !isWord(order.client) || !isWord(order.command.name) ||
      order.sequence < 0) {
    throw wrong;
  }
  return order;
}

Gate::Gate(const PageServerOptions &options, int port)
    : m_address{options.address.host, port}, m_token(options.token), m_free(options.withoutToken),
      m_perSecond(options.commandsPerSecond), m_allowance(options.commandsPerSecond)
{}

std::optional<PageAnswer> Gate::refuseGet(const Visitor &visitor, bool guarded) const
{
  if (!knowsHost(visitor.host)) {
    return PageAnswer{403, "another host was asked for"};
  }
  if (!visitor.origin.empty() && visitor.origin != "http://" + visitor.host) {
    return PageAnswer{403, "another page asked"};
  }
  if (guarded && !m_address.loopback() && !hasToken(visitor)) {
    return PageAnswer{403, "the token is missing or wrong"};
  }
  return std::nullopt;
}

std::optional<PageAnswer> Gate::refuseOrder(const Visitor &visitor, const Order &order,
                                            Clock::time_point now)
{
  if (visitor.origin.empty()) {
    return PageAnswer{403, "no page asked"};
  }
  if (auto refusal = refuseGet(visitor, false)) {
    return refusal;
  }
  const std::lock_guard lock(m_mutex);
  if (m_free.count(order.command.name) > 0) {
    return std::nullopt; // twice is no harm
  }
  if (tooMany(now)) {
    return PageAnswer{429, "too many commands"};
  }
  if (!hasToken(visitor)) {
    return PageAnswer{403, "the token is missing or wrong"};
  }
  if (seenBefore(order)) {
    return PageAnswer{409, "that command was given before"};
  }
  if (m_commander.empty() || order.take) {
    m_commander = order.client;
  }
  if (m_commander != order.client) {
    return PageAnswer{423, "somebody else commands; take over first"};
  }
  return std::nullopt;
}

std::string Gate::commander() const
{
  const std::lock_guard lock(m_mutex);
  return m_commander;
}

bool Gate::leave(const std::string &client)
{
  const std::lock_guard lock(m_mutex);
  if (client.empty() || client != m_commander) {
    return false;
  }
  m_commander.clear();
  return true;
}

bool Gate::knowsHost(const std::string &host) const
{
  const std::size_t colon = host.rfind(':');
  if (colon == std::string::npos || host.substr(colon + 1) != std::to_string(m_address.port)) {
    return false;
  }
  std::string name = host.substr(0, colon);
  if (name.size() > 2 && name.front() == '[' && name.back() == ']') {
    name = name.substr(1, name.size() - 2);
  }
  if (name == m_address.host || ServeAddress{name, 0}.loopback()) {
    return true;
  }
  // A page of elsewhere can make its own name mean this computer, but not an address.
  return !m_address.loopback() && (isAddress(name) || isComputersName(name));
}

bool Gate::hasToken(const Visitor &visitor) const
{
  return !m_token.empty() && equal(visitor.token, m_token);
}

bool Gate::tooMany(Clock::time_point now)
{
  const std::chrono::duration<double> passed = now - m_last;
  m_allowance = std::min(m_perSecond, m_allowance + m_perSecond * passed.count());
  m_last = now;
  if (m_allowance < 1.0) {
    return true;
  }
  m_allowance -= 1.0;
  return false;
}

bool Gate::seenBefore(const Order &order)
{
  const auto known = m_sequences.find(order.client);
  if (known != m_sequences.end()) {
    const bool old = order.sequence <= known->second;
    known->second = std::max(known->second, order.sequence);
    return old;
  }
  if (m_sequences.size() >= kMostClients) {
    return true; // who they were must not be forgotten
  }
  m_sequences[order.client] = order.sequence;
  return false;
}

} // namespace homeward
