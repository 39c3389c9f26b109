// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/drivers/protocol/cola.h>

#include <homeward/core/angle.h>
#include <homeward/core/error.h>

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>

namespace homeward
{
namespace
{

constexpr char kStart = 0x02;
constexpr char kEnd = 0x03;
constexpr std::size_t kLongest =
    65536; ///< a telegram of 1081 distances and as many echoes has 11 k
constexpr double kAngleUnit = radians(1e-4);
constexpr double kAhead = kPi / 2.0; ///< the scanner's own angle there
constexpr unsigned kWords = 4;       ///< counts below say why there is no distance

/** Takes words off the front of a telegram and remembers whether one was missing or wrong. */
class WordReader
{
public:
  explicit WordReader(std::string_view text) : m_rest(text) {}

  bool ok() const { return m_ok; }

  std::string_view word()
  {
    while (!m_rest.empty() && m_rest.front() == ' ') {
      m_rest.remove_prefix(1);
    }
    const std::string_view found = m_rest.substr(0, m_rest.find(' '));
    m_rest.remove_prefix(found.size());
    m_ok = m_ok && !found.empty();
    return found;
  }

  template <class Whole> Whole number()
  {
    std::string_view digits = word();
    const bool decimal = digits.starts_with('+') || digits.starts_with('-');
    const bool negative = digits.starts_with('-');
    digits.remove_prefix(decimal ? 1 : 0);
    std::uint32_t value = 0;
    const char *end = digits.data() + digits.size();
    const auto parsed = std::from_chars(digits.data(), end, value, decimal ? 10 : 16);
    m_ok = m_ok && parsed.ec == std::errc() && parsed.ptr == end &&
           (std::is_signed_v<Whole> || value <= std::numeric_limits<Whole>::max());
    return static_cast<Whole>(negative ? 0U - value : value);
  }

  /** A number of single precision by its bits. */
  float real() { return std::bit_cast<float>(number<std::uint32_t>()); }

  void skip(std::size_t count)
  {
    for (std::size_t i = 0; i < count && m_ok; ++i) {
      word();
    }
  }

private:
  std::string_view m_rest;
  bool m_ok = true;
};

void append(std::string &text, std::uint32_t number)
{
  std::array<char, 9> digits{' '};
  const auto end = std::to_chars(digits.data() + 1, digits.data() + digits.size(), number, 16).ptr;
  for (const char *digit = digits.data(); digit != end; ++digit) {
    text.push_back(*digit >= 'a' ? static_cast<char>(*digit - 'a' + 'A') : *digit);
  }
}

/** One channel of 16 bits, after its name. */
void readChannel(WordReader &words, ColaScan &scan)
{
  scan.scale = words.real();
  scan.offset = words.real();
  scan.startAngle = words.number<std::int32_t>();
  scan.angleStep = words.number<std::uint16_t>();
  const auto count = words.number<std::uint16_t>();
  scan.counts.clear();
  for (unsigned i = 0; i < count && words.ok(); ++i) {
    scan.counts.push_back(words.number<std::uint16_t>());
  }
}

} // namespace

Bytes frameCola(std::string_view text)
{
  if (text.find(kStart) != std::string_view::npos || text.find(kEnd) != std::string_view::npos) {
    throw LogicError("CoLa telegram with a start or an end in it");
  }
  const std::string frame = kStart + std::string(text) + kEnd;
  return {frame.begin(), frame.end()};
}

void ColaReader::push(std::span<const std::uint8_t> bytes)
{
  m_text.append(bytes.begin(), bytes.end());
}

std::optional<std::string> ColaReader::next()
{
  for (std::size_t end = m_text.find(kEnd); end != std::string::npos; end = m_text.find(kEnd)) {
    const std::size_t start = m_text.rfind(kStart, end);
    std::string telegram =
        start == std::string::npos ? "" : m_text.substr(start + 1, end - start - 1);
    m_text.erase(0, end + 1);
    if (!telegram.empty()) {
      return telegram;
    }
  }
  const std::size_t start = m_text.rfind(kStart);
  const bool hopeless = start == std::string::npos || m_text.size() - start > kLongest;
  m_text.erase(0, hopeless ? std::string::npos : start);
  return std::nullopt;
}

std::string encodeColaScan(const ColaScan &scan)
{
  // Version, device, serial number, its status, telegrams, scans.
  std::string text = "sSN LMDscandata 1 1 1 0 0 1 1";
  append(text, scan.begun);
  append(text, scan.sent);
  text += " 0 0 0 0 0 1388 168 0 1 DIST1"; // inputs, outputs, rates, no encoders, one channel
  append(text, std::bit_cast<std::uint32_t>(scan.scale));
  append(text, std::bit_cast<std::uint32_t>(scan.offset));
  append(text, static_cast<std::uint32_t>(scan.startAngle));
  append(text, scan.angleStep);
  append(text, static_cast<std::uint32_t>(scan.counts.size()));
  for (const std::uint16_t count : scan.counts) {
    append(text, count);
  }
  return text + " 0 0 0 0 0 0"; // no channels of 8 bits, position, name, comment, time, event
}

std::optional<ColaScan> parseColaScan(std::string_view telegram)
{
  constexpr std::size_t kBeforeTimes = 7;    // version to scan counter
  constexpr std::size_t kBeforeEncoders = 7; // inputs, outputs, reserved, rates
  WordReader words(telegram);
  const std::string_view kind = words.word();
  if ((kind != "sSN" && kind != "sRA") || words.word() != "LMDscandata") {
    return std::nullopt;
  }
  ColaScan scan;
  words.skip(kBeforeTimes);
  scan.begun = words.number<std::uint32_t>();
  scan.sent = words.number<std::uint32_t>();
  words.skip(kBeforeEncoders);
  words.skip(2 * std::size_t{words.number<std::uint16_t>()});
  for (unsigned left = words.number<std::uint16_t>(); left > 0 && words.ok(); --left) {
    const bool distances = words.word() == "DIST1";
    readChannel(words, scan);
    if (distances) {
      const bool real = std::isfinite(scan.scale) && std::isfinite(scan.offset);
      return words.ok() && real ? std::optional(scan) : std::nullopt;
    }
  }
  return std::nullopt;
}

Scan colaRanges(const ColaScan &scan, double rangeMax, Time stamp)
{
  if (scan.angleStep == 0) {
    throw LogicError("CoLa scan whose readings have no step");
  }
  Scan result;
  result.stamp = stamp;
  result.angleMin = scan.startAngle * kAngleUnit - kAhead;
  result.angleStep = scan.angleStep * kAngleUnit;
  result.rangeMax = rangeMax;
  result.ranges.reserve(scan.counts.size());
  for (const std::uint16_t count : scan.counts) {
    const float range = (static_cast<float>(count) * scan.scale + scan.offset) / 1000.0F;
    result.ranges.push_back(count < kWords || range < 0.0F ? kUnknownRange : range);
  }
  return result;
}

} // namespace homeward
