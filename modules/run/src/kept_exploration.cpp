// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/run/kept_exploration.h>

#include <homeward/core/error.h>

#include <nlohmann/json.hpp>

#include <cstdint>
#include <set>
#include <utility>

namespace homeward
{
using nlohmann::json;

namespace
{

constexpr int kVersion = 1;

using Phase = ExplorerState::Phase;
const char *word(Phase phase)
{
  switch (phase) {
  case Phase::Surveying:
    return "surveying";
  case Phase::Driving:
    return "driving";
  case Phase::Classifying:
    return "classifying";
  case Phase::Homing:
    return "homing";
  case Phase::Following:
    return "following";
  case Phase::Striding:
    return "striding";
  case Phase::Relocating:
    return "relocating";
  case Phase::Retreating:
    return "retreating";
  case Phase::Returning:
    return "returning";
  case Phase::Finished:
    return "finished";
  }
  throw LogicError("an unknown phase of the exploration");
}

/** Every field of a state with its key. A new field does not compile until it is kept too. */
template <class State, class Visit> void eachField(State &state, Visit visit)
{
  auto &[steps, phase, origin, direction, route, target, surely, strode, retreated, dissimilarity,
         retries, vain, refuted, alike, stranded, failures, attempts, chord] = state;
  visit("steps", steps);
  visit("phase", phase);
  visit("origin", origin);
  visit("direction", direction);
  visit("route", route);
  visit("target", target);
  visit("surely", surely);
  visit("strode", strode);
  visit("retreated", retreated);
  visit("dissimilarity", dissimilarity);
  visit("retries", retries);
  visit("vain", vain);
  visit("refuted", refuted);
  visit("alike", alike);
  visit("stranded", stranded);
  visit("failures", failures);
  visit("attempts", attempts);
  visit("chord", chord);
}

json toJson(int value)
{
  return value;
}

json toJson(bool value)
{
  return value;
}

json toJson(double value)
{
  return value;
}

json toJson(Phase phase)
{
  return word(phase);
}

json toJson(const Chord &chord)
{
  return {chord.distance, chord.travelled, chord.bearingAtOrigin, chord.bearingAtHere};
}

template <class Tag> json toJson(Id<Tag> id)
{
  return id.value;
}

template <class A, class B> json toJson(const std::pair<A, B> &pair)
{
  return {toJson(pair.first), toJson(pair.second)};
}

template <class Value> json toJson(const std::optional<Value> &value)
{
  return value ? toJson(*value) : json();
}

template <class Value> json toJson(const std::vector<Value> &values)
{
  json list = json::array();
  for (const Value &value : values) {
    list.push_back(toJson(value));
  }
  return list;
}

template <class Key, class Value> json toJson(const std::map<Key, Value> &values)
{
  json list = json::array();
  for (const auto &[key, value] : values) {
    list.push_back({toJson(key), toJson(value)});
  }
  return list;
}

void read(const json &from, std::int64_t &value)
{
  if (!from.is_number_integer()) {
    throw ConfigError(from.dump() + " is no whole number");
  }
  value = from.get<std::int64_t>();
}

void read(const json &from, int &value)
{
  std::int64_t wide = 0;
  read(from, wide);
  value = static_cast<int>(wide);
}

void read(const json &from, bool &value)
{
  from.get_to(value);
}

void read(const json &from, double &value)
{
  from.get_to(value);
}

void read(const json &from, Phase &phase)
{
  const auto text = from.get<std::string>();
  for (int i = 0; i <= static_cast<int>(Phase::Finished); ++i) {
    if (text == word(static_cast<Phase>(i))) {
      phase = static_cast<Phase>(i);
      return;
    }
  }
  throw ConfigError("'" + text + "' is no phase");
}

void expectList(const json &list)
{
  if (!list.is_array()) {
    throw ConfigError(list.dump() + " is no list");
  }
}

void expectLength(const json &list, std::size_t length)
{
  if (!list.is_array() || list.size() != length) {
    throw ConfigError(list.dump() + " is no list of " + std::to_string(length));
  }
}

void read(const json &from, Chord &chord)
{
  expectLength(from, 4);
  from[0].get_to(chord.distance);
  from[1].get_to(chord.travelled);
  from[2].get_to(chord.bearingAtOrigin);
  from[3].get_to(chord.bearingAtHere);
}

template <class Tag> void read(const json &from, Id<Tag> &id)
{
  read(from, id.value);
}

template <class A, class B> void read(const json &from, std::pair<A, B> &pair)
{
  expectLength(from, 2);
  read(from[0], pair.first);
  read(from[1], pair.second);
}

template <class Value> void read(const json &from, std::optional<Value> &value)
{
  if (!from.is_null()) {
    read(from, value.emplace());
  }
}

template <class Value> void read(const json &from, std::vector<Value> &values)
{
  expectList(from);
  for (const json &each : from) {
    read(each, values.emplace_back());
  }
}

template <class Key, class Value> void read(const json &from, std::map<Key, Value> &values)
{
  expectList(from);
  for (const json &each : from) {
    std::pair<Key, Value> entry;
    read(each, entry);
    values.insert(entry);
  }
}

void expectVersion(const json &value)
{
  const int version = value.at("version").get<int>();
  if (version < 1 || version > kVersion) {
    throw ConfigError("it has version " + std::to_string(version) + ", this program reads up to " +
                      std::to_string(kVersion));
  }
}

ExplorerState stateFrom(const json &value)
{
  expectVersion(value);
  ExplorerState state;
  std::set<std::string> known{"version"};
  eachField(state, [&](const char *key, auto &field) {
    known.insert(key);
    if (value.contains(key)) {
      read(value.at(key), field);
    }
  });
  for (const auto &[key, unused] : value.items()) {
    if (known.count(key) == 0) {
      throw ConfigError("it has an unknown key " + key);
    }
  }
  return state;
}

} // namespace

std::string explorerStateJson(const ExplorerState &state)
{
  json value{{"version", kVersion}};
  eachField(state, [&](const char *key, const auto &field) { value[key] = toJson(field); });
  return value.dump();
}

ExplorerState parseExplorerState(const std::string &text)
{
  try {
    return stateFrom(json::parse(text));
  }
  catch (const json::exception &error) {
    throw ConfigError(std::string("the exploration's state cannot be read: ") + error.what());
  }
  catch (const ConfigError &error) {
    throw ConfigError(std::string("the exploration's state cannot be read: ") + error.what());
  }
}

std::optional<ExplorerState> keptExploration(const MapFile &file)
{
  const std::optional<std::string> text = file.value(kExplorationKey);
  if (!text) {
    return std::nullopt;
  }
  try {
    return parseExplorerState(*text);
  }
  catch (const ConfigError &error) {
    throw StoreError("map " + file.path().string() + ": " + error.what() +
                     "; go on with the program that wrote it, or make a new map");
  }
}

} // namespace homeward
