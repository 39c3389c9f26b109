// SPDX-License-Identifier: GPL-3.0-or-later
#include "xml.h"

#include <homeward/core/error.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>

namespace homeward
{
namespace
{

class Parser
{
public:
  Parser(const std::string &text, const std::string &origin) : m_text(text), m_origin(origin) {}

  XmlElement root()
  {
    skip();
    XmlElement element = this->element(0);
    skip();
    if (m_at < m_text.size()) {
      fail("something follows the root element");
    }
    return element;
  }

private:
  [[noreturn]] void fail(const std::string &what) const
  {
    const auto end = m_text.begin() + static_cast<std::ptrdiff_t>(std::min(m_at, m_text.size()));
    const auto line = 1 + std::count(m_text.begin(), end, '\n');
    throw ConfigError(m_origin + ", line " + std::to_string(line) + ": " + what +
                      "; the file is no XML that this program reads");
  }

  bool starts(const char *with) const
  {
    return m_text.compare(m_at, std::string(with).size(), with) == 0;
  }

  void past(const char *end)
  {
    const auto found = m_text.find(end, m_at);
    if (found == std::string::npos) {
      fail(std::string("'") + end + "' is missing");
    }
    m_at = found + std::string(end).size();
  }

  /** Blanks, comments and declarations. */
  void skip()
  {
    for (;;) {
      while (m_at < m_text.size() && std::isspace(static_cast<unsigned char>(m_text[m_at])) != 0) {
        ++m_at;
      }
      if (starts("<!--")) {
        past("-->");
      }
      else if (starts("<?") || starts("<!")) {
        past(">");
      }
      else {
        return;
      }
    }
  }

  XmlElement element(int depth)
  {
    constexpr int kDeepest = 50;
    if (depth > kDeepest) {
      fail("elements stand too deep in each other");
    }
    if (!starts("<") || starts("</")) {
      fail("an element should start here");
    }
    XmlElement result;
    ++m_at;
    const auto end = m_text.find_first_of(" \t\r\n/>", m_at);
    if (end == std::string::npos || end == m_at) {
      fail("an element has no name");
    }
    result.name = m_text.substr(m_at, end - m_at);
    m_at = end;
    past(">");
    if (m_text[m_at - 2] == '/') {
      return result;
    }
    for (;;) {
      skip();
      if (starts("</")) {
        m_at += 2;
        if (m_text.compare(m_at, result.name.size(), result.name) != 0) {
          fail("'" + result.name + "' is not closed");
        }
        past(">");
        return result;
      }
      if (starts("<")) {
        result.children.push_back(element(depth + 1));
        continue;
      }
      const auto next = m_text.find('<', m_at);
      if (next == std::string::npos) {
        fail("'" + result.name + "' is not closed");
      }
      result.text += m_text.substr(m_at, next - m_at);
      m_at = next;
    }
  }

  const std::string &m_text;
  const std::string &m_origin;
  std::size_t m_at = 0;
};

} // namespace

const XmlElement *XmlElement::child(const std::string &childName) const
{
  for (const XmlElement &element : children) {
    if (element.name == childName) {
      return &element;
    }
  }
  return nullptr;
}

XmlElement parseXml(const std::string &text, const std::string &origin)
{
  return Parser(text, origin).root();
}

double xmlNumber(const XmlElement &element, const std::string &child, const std::string &origin)
{
  const XmlElement *found = element.child(child);
  if (found == nullptr) {
    throw ConfigError(origin + ": <" + child + "> is missing in <" + element.name + ">");
  }
  char *end = nullptr;
  const double value = std::strtod(found->text.c_str(), &end);
  while (*end != '\0' && std::isspace(static_cast<unsigned char>(*end)) != 0) {
    ++end;
  }
  if (found->text.empty() || *end != '\0' || !std::isfinite(value)) {
    throw ConfigError(origin + ": <" + child + "> must be a number, not '" + found->text + "'");
  }
  return value;
}

} // namespace homeward
