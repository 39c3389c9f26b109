// SPDX-License-Identifier: GPL-3.0-or-later
#include "urdf_document.h"

#include <homeward/core/error.h>

#include <algorithm>
#include <console_bridge/console.h>
#include <exception>
#include <mutex>
#include <urdf_parser/urdf_parser.h>

namespace homeward
{
namespace
{

/** Keeps the first error that the URDF parser would print. */
class FirstError : public console_bridge::OutputHandler
{
public:
  void log(const std::string &text, console_bridge::LogLevel level, const char * /*file*/,
           int /*line*/) override
  {
    if (m_text.empty() && level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR) {
      m_text = text;
    }
  }

  /** The message on one line. */
  std::string text() const
  {
    std::string line = m_text.empty() ? "the parser gives no reason" : m_text;
    std::replace(line.begin(), line.end(), '\n', ' ');
    return line;
  }

private:
  std::string m_text;
};

/** Routes console_bridge, which is global, to `handler` for a while; one user at a time. */
class RoutedConsole
{
public:
  explicit RoutedConsole(console_bridge::OutputHandler &handler) : m_lock(s_mutex)
  {
    console_bridge::useOutputHandler(&handler);
  }
  ~RoutedConsole() { console_bridge::useOutputHandler(m_previous); }
  RoutedConsole(const RoutedConsole &) = delete;
  RoutedConsole &operator=(const RoutedConsole &) = delete;

private:
  static inline std::mutex s_mutex;
  std::lock_guard<std::mutex> m_lock;
  console_bridge::OutputHandler *m_previous = console_bridge::getOutputHandler();
};

} // namespace

urdf::ModelInterfaceSharedPtr parseUrdfDocument(const std::string &xml, const std::string &origin)
{
  FirstError error;
  const RoutedConsole routed(error);
  urdf::ModelInterfaceSharedPtr model;
  try {
    model = urdf::parseURDF(xml);
  }
  catch (const std::exception &exception) {
    throw ConfigError(origin + ": not a URDF document: " + exception.what());
  }
  if (!model) {
    throw ConfigError(origin + ": not a URDF document: " + error.text());
  }
  return model;
}

} // namespace homeward
