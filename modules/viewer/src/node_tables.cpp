// SPDX-License-Identifier: GPL-3.0-or-later
#include "node_tables.h"

#include <homeward/core/angle.h>

#include <array>
#include <cstdio>

namespace homeward
{

namespace
{

constexpr double kTextSize = 8.0;     // height of a capital, pixels
constexpr double kSymbolWidth = 16.0; // pixels

std::string decimals(double value, int digits)
{
  std::array<char, 64> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.*f", digits, value);
  return buffer.data();
}

std::string nodeText(const Node &node)
{
  return std::to_string(node.id.value) + (node.name.empty() ? "" : " " + node.name);
}

NodeTable directionTable(const Node &node)
{
  NodeTable table{
      "Directions", {{"bearing", 0.18}, {"width", 0.15}, {"state", 0.15}, {"because", 0.52}}, {}};
  for (const Direction &direction : node.directions) {
    table.rows.push_back({bearingText(direction.bearing),
                          decimals(degrees(direction.width), 0) + " deg",
                          std::string(name(direction.state)), direction.reason});
    table.states.push_back(direction.state);
  }
  return table;
}

NodeTable neighbourTable(const TopologicalMap &map, NodeId node)
{
  NodeTable table{"Neighbours",
                  {{"node", 0.2},
                   {"bearing", 0.16},
                   {"length", 0.13},
                   {"arrived", 0.15},
                   {"mean time", 0.15},
                   {"last failure", 0.21}},
                  {}};
  for (const Link &link : map.links(node)) {
    const Edge &edge = map.edge(link.edge);
    const EdgeStatistics &drives = edge.statistics;
    table.rows.push_back({nodeText(map.node(link.to)),
                          bearingText(map.departureBearing(node, link.to)),
                          edge.length ? decimals(*edge.length, 2) + " m" : "unknown",
                          std::to_string(drives.successes) + " of " + std::to_string(drives.tries),
                          drives.successes > 0 ? decimals(drives.meanSeconds, 1) + " s" : "-",
                          edge.forbidden ? "no-go" : drives.lastError});
  }
  return table;
}

NodeTable alikeTable(const TopologicalMap &map, const std::vector<AlikePlace> &alike)
{
  NodeTable table{
      "Looks most like", {{"node", 0.36}, {"distance", 0.22}, {"same place", 0.42}}, {}};
  for (const AlikePlace &place : alike) {
    table.rows.push_back({nodeText(map.node(place.node)), decimals(place.distance, 3),
                          decimals(100.0 * place.probability, 1) + " %"});
  }
  return table;
}

} // namespace

double NodeTable::height() const
{
  return kHeadHeight + kRowHeight * static_cast<double>(std::max<std::size_t>(rows.size(), 1)) +
         kGap;
}

void NodeTable::draw(Canvas &canvas, const Point &corner, double width) const
{
  canvas.text(corner + Point(0.0, 12.0), title, 10.0, palette::kInk, Anchor::Left);
  const double symbols = states.empty() ? 0.0 : kSymbolWidth;
  const auto line = [&](const std::vector<std::string> &words, double y, Colour colour) {
    double x = symbols;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const double room = (width - symbols) * columns[i].share;
      if (!words[i].empty()) {
        canvas.text(corner + Point(x, y), clipped(words[i], kTextSize, room - 6.0), kTextSize,
                    colour, Anchor::Left);
      }
      x += room;
    }
  };
  std::vector<std::string> heads;
  for (const TableColumn &column : columns) {
    heads.push_back(column.head);
  }
  line(heads, 34.0, palette::kFaint);
  canvas.line({corner + Point(0.0, 41.0), corner + Point(width, 41.0)},
              {std::nullopt, palette::kGrid, 1.0});
  double y = kHeadHeight + 8.0;
  if (rows.empty()) {
    canvas.text(corner + Point(symbols, y), "none", kTextSize, palette::kFaint, Anchor::Left);
  }
  for (std::size_t row = 0; row < rows.size(); ++row) {
    if (!states.empty()) {
      drawDirection(canvas, corner + Point(-kNodeRadius - 3.0, y - 0.5 * kTextSize), 0.0,
                    states[row]);
    }
    line(rows[row], y, palette::kInk);
    y += kRowHeight;
  }
}

std::string bearingText(const std::optional<double> &bearing)
{
  if (!bearing) {
    return "unknown";
  }
  std::array<char, 32> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%+ld deg",
                std::lround(degrees(wrapAngle(*bearing))));
  return buffer.data();
}

std::vector<NodeTable> nodeTables(const TopologicalMap &map, NodeId node,
                                  const std::vector<AlikePlace> &alike)
{
  return {directionTable(map.node(node)), neighbourTable(map, node), alikeTable(map, alike)};
}

} // namespace homeward
