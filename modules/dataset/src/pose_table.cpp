// SPDX-License-Identifier: GPL-3.0-or-later
#include "pose_table.h"

#include <homeward/core/error.h>

#include <charconv>
#include <cmath>
#include <set>
#include <sstream>
#include <string_view>

namespace homeward
{

namespace
{

constexpr std::string_view kHeader = "file,x_m,y_m,heading_rad,light";
constexpr std::size_t kFields = 5;

/** Where in the table something stands, for messages. */
struct Spot
{
  const std::string &origin;
  int line;

  ConfigError error(const std::string &problem) const
  {
    return ConfigError(origin + " line " + std::to_string(line) + ": " + problem);
  }
};

std::string_view trimmed(std::string_view text)
{
  constexpr std::string_view kBlank = " \t\r";
  const std::size_t from = text.find_first_not_of(kBlank);
  return from == std::string_view::npos
             ? std::string_view()
             : text.substr(from, text.find_last_not_of(kBlank) - from + 1);
}

std::vector<std::string_view> fieldsOf(std::string_view line)
{
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t comma = line.find(',');
    fields.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) {
      return fields;
    }
    line.remove_prefix(comma + 1);
  }
}

double numberOf(std::string_view text, const char *column, const Spot &spot)
{
  double value = 0.0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
    throw spot.error(std::string(column) + " must be a number, not '" + std::string(text) + "'");
  }
  return value;
}

DataSetView viewOf(std::string_view line, const Spot &spot)
{
  const std::vector<std::string_view> fields = fieldsOf(line);
  if (fields.size() != kFields) {
    throw spot.error("has " + std::to_string(fields.size()) +
                     " fields, must have 5: " + std::string(kHeader));
  }
  if (fields[0].empty() || fields[4].empty()) {
    throw spot.error(fields[0].empty() ? "names no file" : "names no light, write any word");
  }
  DataSetView view;
  view.file = fields[0];
  view.pose.x = numberOf(fields[1], "x_m", spot);
  view.pose.y = numberOf(fields[2], "y_m", spot);
  view.pose.heading = wrapAngle(numberOf(fields[3], "heading_rad", spot));
  view.light = fields[4];
  return view;
}

} // namespace

std::vector<DataSetView> parsePoseTable(const std::string &text, const std::string &origin)
{
  std::istringstream stream(text);
  std::vector<DataSetView> views;
  std::set<std::string> names;
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    const Spot spot{origin, number};
    const std::string_view content = trimmed(line);
    if (number == 1) {
      if (content != kHeader) {
        throw spot.error("must be the header " + std::string(kHeader));
      }
      continue;
    }
    if (content.empty()) {
      continue;
    }
    views.push_back(viewOf(content, spot));
    if (!names.insert(views.back().file).second) {
      throw spot.error(views.back().file + " stands in the table already");
    }
  }
  if (views.empty()) {
    throw ConfigError(origin + " names no picture: write the header " + std::string(kHeader) +
                      " and a line for each");
  }
  return views;
}

std::string formatPoseTable(const std::vector<DataSetView> &views)
{
  std::ostringstream text;
  text.precision(17);
  text << kHeader << '\n';
  for (const DataSetView &view : views) {
    text << view.file << ',' << view.pose.x << ',' << view.pose.y << ',' << view.pose.heading << ','
         << view.light << '\n';
  }
  return text.str();
}

} // namespace homeward
