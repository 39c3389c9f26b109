// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/laser/carmen_log.h>

#include <homeward/core/error.h>

#include <zlib.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace homeward
{
namespace
{

/** A text file, compressed or not, line by line. */
class LineReader
{
public:
  explicit LineReader(const std::filesystem::path &file)
      : m_name(file.string()), m_file(gzopen(m_name.c_str(), "rb"))
  {
    if (!m_file) {
      throw ConfigError(m_name + ": cannot be opened; check the name and the rights");
    }
  }

  /** The next line without its end; nothing after the last. Valid until the next call. */
  std::optional<std::string_view> next()
  {
    while (true) {
      const std::size_t end = m_buffer.find('\n', m_begin);
      if (end != std::string::npos) {
        return line(end, end + 1);
      }
      if (m_atEnd) {
        if (m_begin == m_buffer.size()) {
          return std::nullopt;
        }
        return line(m_buffer.size(), m_buffer.size());
      }
      if (m_buffer.size() - m_begin > kLongest) {
        fail("holds a line of more than a megabyte; is this a CARMEN log?", 1);
      }
      read();
    }
  }

  /** @throw ConfigError naming file and the line read last, or `ahead` lines after it */
  [[noreturn]] void fail(const std::string &what, std::size_t ahead = 0) const
  {
    throw ConfigError(m_name + ":" + std::to_string(m_line + ahead) + ": " + what);
  }

private:
  static constexpr std::size_t kLongest = 1U << 20U;

  std::string_view line(std::size_t end, std::size_t next)
  {
    std::string_view text(m_buffer.data() + m_begin, end - m_begin);
    m_begin = next;
    ++m_line;
    if (!text.empty() && text.back() == '\r') {
      text.remove_suffix(1);
    }
    return text;
  }

  void read()
  {
    std::array<char, 1U << 16U> chunk{};
    m_buffer.erase(0, m_begin);
    m_begin = 0;
    const int count = gzread(m_file.get(), chunk.data(), static_cast<unsigned>(chunk.size()));
    int error = Z_OK;
    gzerror(m_file.get(), &error);
    if (count < 0 || error == Z_BUF_ERROR) {
      fail(error == Z_BUF_ERROR ? "the compressed file ends too early; copy it again"
                                : "the file cannot be read or is damaged; copy it again",
           1);
    }
    m_buffer.append(chunk.data(), static_cast<std::size_t>(count));
    m_atEnd = count == 0;
  }

  struct Close
  {
    void operator()(gzFile file) const { gzclose(file); }
  };

  std::string m_name;
  std::unique_ptr<gzFile_s, Close> m_file;
  std::string m_buffer;
  std::size_t m_begin = 0;
  std::size_t m_line = 0;
  bool m_atEnd = false;
};

/** The words of a line, one after the other. */
class Words
{
public:
  Words(const LineReader &reader, std::string_view line) : m_reader(reader), m_rest(line) {}

  std::string_view word()
  {
    constexpr std::string_view kSpace = " \t";
    const std::size_t begin = std::min(m_rest.find_first_not_of(kSpace), m_rest.size());
    m_rest.remove_prefix(begin);
    const std::size_t end = std::min(m_rest.find_first_of(kSpace), m_rest.size());
    const std::string_view found = m_rest.substr(0, end);
    m_rest.remove_prefix(end);
    return found;
  }

  double number(const char *what)
  {
    const std::string_view text = word();
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty()) {
      m_reader.fail(std::string("FLASER ends before its ") + what);
    }
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) {
      m_reader.fail(std::string("FLASER has the ") + what + " \"" + std::string(text) +
                    "\", which is not a number");
    }
    return value;
  }

  Pose2 pose(const char *what)
  {
    const double x = number(what);
    const double y = number(what);
    return {x, y, wrapAngle(number(what))};
  }

private:
  const LineReader &m_reader;
  std::string_view m_rest;
};

CarmenScan parseScan(const LineReader &reader, Words &words)
{
  constexpr double kLatest = 9e9; // s; what a nanosecond clock holds
  const double count = words.number("number of readings");
  const bool whole = count == 180.0 || count == 181.0;
  if (!whole && count != 360.0 && count != 361.0) {
    reader.fail("FLASER has " + std::to_string(count) +
                " readings; 180, 181, 360 and 361 are understood");
  }
  CarmenScan read;
  read.scan.angleMin = -kPi / 2.0;
  read.scan.angleStep = radians(whole ? 1.0 : 0.5);
  read.scan.ranges.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < static_cast<int>(count); ++i) {
    const double range = words.number("range");
    if (range < 0.0) {
      reader.fail("FLASER has the range " + std::to_string(range) + " m, below 0");
    }
    read.scan.ranges.push_back(static_cast<float>(range));
  }
  read.pose = words.pose("pose");
  read.odometry = words.pose("odometry");
  read.time = words.number("time");
  const std::string_view host = words.word();
  words.number(host.empty() ? "host" : "logger's time");
  if (!words.word().empty()) {
    reader.fail("FLASER goes on after the logger's time; does its number of readings fit?");
  }
  if (std::abs(read.time) > kLatest) {
    reader.fail("FLASER has the time " + std::to_string(read.time) + " s, beyond any clock");
  }
  read.scan.stamp = Time{fromSeconds(read.time)};
  return read;
}

/** What the sensor can see, from the largest reading; see readCarmenLog(). Metres. */
float sensorRange(float largest)
{
  constexpr std::array<std::array<float, 2>, 5> kSettings{
      {{8.0F, 8.2F}, {16.0F, 16.4F}, {32.0F, 32.8F}, {50.0F, 51.2F}, {80.0F, 82.0F}}};
  for (const auto &[range, code] : kSettings) {
    if (largest <= code) {
      return range;
    }
  }
  return largest;
}

} // namespace

CarmenLog readCarmenLog(const std::filesystem::path &file)
{
  LineReader reader(file);
  CarmenLog log;
  float largest = 0.0F;
  while (const std::optional<std::string_view> line = reader.next()) {
    Words words(reader, *line);
    const std::string_view kind = words.word();
    if (kind == "ODOM") {
      ++log.odometryLines;
    }
    else if (kind == "FLASER") {
      log.scans.push_back(parseScan(reader, words));
      const std::vector<float> &ranges = log.scans.back().scan.ranges;
      largest = std::max(largest, *std::max_element(ranges.begin(), ranges.end()));
    }
  }
  if (log.scans.empty() && log.odometryLines == 0) {
    reader.fail("no FLASER or ODOM line up to here; this is not a CARMEN log");
  }
  for (CarmenScan &scan : log.scans) {
    scan.scan.rangeMax = sensorRange(largest);
  }
  return log;
}

} // namespace homeward
