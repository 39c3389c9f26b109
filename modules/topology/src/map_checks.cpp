// SPDX-License-Identifier: GPL-3.0-or-later
#include "map_checks.h"

#include <homeward/core/error.h>

#include <algorithm>
#include <cmath>

namespace homeward
{

namespace
{

bool isControl(char c)
{
  return static_cast<unsigned char>(c) < 0x20U || c == '\x7f';
}

bool isDigit(char c)
{
  return c >= '0' && c <= '9';
}

void checkBearing(EdgeId id, const std::optional<double> &bearing)
{
  if (bearing && !std::isfinite(*bearing)) {
    refuse(text(id) + ": bearing " + std::to_string(*bearing) + " is not finite");
  }
}

} // namespace

void refuse(const std::string &what)
{
  throw LogicError("topological map: " + what);
}

std::string text(NodeId id)
{
  return "node " + std::to_string(id.value);
}

std::string text(EdgeId id)
{
  return "edge " + std::to_string(id.value);
}

std::string text(NodeId node, DirectionId id)
{
  return "direction " + std::to_string(id.value) + " of " + text(node);
}

void checkDirections(const Node &node)
{
  for (std::size_t i = 0; i < node.directions.size(); ++i) {
    const Direction &direction = node.directions[i];
    if (direction.id.value != static_cast<std::int64_t>(i)) {
      refuse(text(node.id, direction.id) + ": the next id is " + std::to_string(i));
    }
    if (!std::isfinite(direction.bearing)) {
      refuse(text(node.id, direction.id) + ": bearing " + std::to_string(direction.bearing) +
             " is not finite");
    }
    if (!std::isfinite(direction.width) || direction.width < 0.0) {
      refuse(text(node.id, direction.id) + ": width " + std::to_string(direction.width) +
             " is not a finite angle of 0 or more");
    }
  }
}

void checkNameText(NodeId id, const std::string &name)
{
  if (std::any_of(name.begin(), name.end(), isControl)) {
    refuse("a name for " + text(id) + " has control characters");
  }
  if (!name.empty() && std::all_of(name.begin(), name.end(), isDigit)) {
    refuse("the name \"" + name + "\" for " + text(id) + " is a number");
  }
}

void checkValues(const Edge &edge)
{
  checkBearing(edge.id, edge.bearingAtA);
  checkBearing(edge.id, edge.bearingAtB);
  if (edge.length && !(std::isfinite(*edge.length) && *edge.length >= 0.0)) {
    refuse(text(edge.id) + ": length " + std::to_string(*edge.length) + " is none");
  }
  checkStatistics(edge.id, edge.statistics);
}

void checkStatistics(EdgeId id, const EdgeStatistics &statistics)
{
  if (statistics.successes < 0 || statistics.tries < statistics.successes) {
    refuse(text(id) + ": " + std::to_string(statistics.successes) + " successes in " +
           std::to_string(statistics.tries) + " tries");
  }
  if (!(std::isfinite(statistics.meanSeconds) && statistics.meanSeconds >= 0.0)) {
    refuse(text(id) + ": " + std::to_string(statistics.meanSeconds) + " s are no duration");
  }
  if (!std::isfinite(statistics.lastTime)) {
    refuse(text(id) + ": time " + std::to_string(statistics.lastTime) + " is not finite");
  }
}

} // namespace homeward
