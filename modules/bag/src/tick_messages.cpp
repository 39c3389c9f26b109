// SPDX-License-Identifier: GPL-3.0-or-later
#include "tick_messages.h"

#include <homeward/core/error.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

namespace homeward
{
using nlohmann::json;

namespace
{

constexpr const char *kAgain = "again";
constexpr const char *kLost = "lost";

std::int64_t toJson(Time at)
{
  return at.time_since_epoch().count();
}

Time timeFrom(const json &told)
{
  return Time(Duration(told.get<std::int64_t>()));
}

/** JSON knows no NaN. */
double numberFrom(const json &told)
{
  return told.is_null() ? std::numeric_limits<double>::quiet_NaN() : told.get<double>();
}

bool same(const Scan &a, const Scan &b)
{
  return a.stamp == b.stamp && a.angleMin == b.angleMin && a.angleStep == b.angleStep &&
         a.rangeMax == b.rangeMax && a.ranges.size() == b.ranges.size() &&
         std::memcmp(a.ranges.data(), b.ranges.data(), a.ranges.size() * sizeof(float)) == 0;
}

const char *word(Device device)
{
  switch (device) {
  case Device::Base:
    return "base";
  case Device::Laser:
    return "laser";
  case Device::Camera:
    return "camera";
  }
  throw LogicError("an unknown device");
}

Device deviceFrom(const std::string &told)
{
  for (const Device device : {Device::Base, Device::Laser, Device::Camera}) {
    if (told == word(device)) {
      return device;
    }
  }
  throw StoreError("'" + told + "' is no device");
}

json sonarJson(const std::vector<SonarEcho> &sonar)
{
  json list = json::array();
  for (const SonarEcho &echo : sonar) {
    list.push_back({echo.bearing, echo.x, echo.y, echo.range});
  }
  return list;
}

BaseState stateFrom(const json &told, BaseState state)
{
  state.stamp = timeFrom(told.at("stamp"));
  state.odometry.heading = told.at("heading").get<double>();
  state.stalled = told.value("stalled", false);
  state.bumpedAhead = told.value("ahead", false);
  state.bumpedBehind = told.value("behind", false);
  state.halt = told.value("halt", std::string());
  for (const json &echo : told.value("sonar", json::array())) {
    state.sonar.push_back({numberFrom(echo.at(0)), numberFrom(echo.at(1)), numberFrom(echo.at(2)),
                           numberFrom(echo.at(3))});
  }
  return state;
}

json faultsJson(const std::vector<DeviceFault> &faults)
{
  json list = json::array();
  for (const DeviceFault &fault : faults) {
    list.push_back({{"device", word(fault.device)}, {"call", fault.call}, {"what", fault.what}});
  }
  return list;
}

/** What is of a tick alone: no message of ROS has it. */
json restOf(const Tick &tick)
{
  json rest{{"event", "tick"}};
  for (const Instant &instant : tick.instants) {
    rest["instants"].push_back({toJson(instant.at), instant.times});
  }
  for (const bool counted : tick.counted) {
    rest["counted"].push_back(counted);
  }
  for (const std::optional<Time> &newest : tick.newest) {
    rest["newest"].push_back(newest ? json(toJson(*newest)) : json());
  }
  if (!tick.faults.empty()) {
    rest["faults"] = faultsJson(tick.faults);
  }
  if (tick.stopAfter) {
    rest["stop_after"] = *tick.stopAfter;
  }
  if (tick.last) {
    rest["last"] = true;
  }
  return rest;
}

/** Inverse of restOf(). */
Tick tickFrom(const json &rest)
{
  Tick tick;
  for (const json &instant : rest.value("instants", json::array())) {
    tick.instants.push_back({timeFrom(instant.at(0)), instant.at(1).get<std::size_t>()});
  }
  for (const json &counted : rest.value("counted", json::array())) {
    tick.counted.push_back(counted.get<bool>());
  }
  for (const json &newest : rest.value("newest", json::array())) {
    tick.newest.push_back(newest.is_null() ? std::nullopt : std::optional(timeFrom(newest)));
  }
  for (const json &fault : rest.value("faults", json::array())) {
    tick.faults.push_back({deviceFrom(fault.at("device").get<std::string>()),
                           fault.at("call").get<std::size_t>(),
                           fault.at("what").get<std::string>()});
  }
  if (rest.contains("stop_after")) {
    tick.stopAfter = rest.at("stop_after").get<std::size_t>();
  }
  tick.last = rest.value("last", false);
  return tick;
}

} // namespace

Time TickEncoder::later(Time at)
{
  m_last = std::max(at + m_epoch, m_last + Duration(1));
  return m_last;
}

void TickEncoder::add(Time at, BagMessage message)
{
  message.at = later(at);
  m_messages.push_back(std::move(message));
}

BagMessage TickEncoder::event(const json &what)
{
  return {later(Time{}), BagEvent{what.dump()}};
}

void TickEncoder::beginBag()
{
  m_scan.reset();
  m_frame.reset();
}

json TickEncoder::tell(Time at, const BaseState &state)
{
  json told{{"stamp", toJson(state.stamp)}, {"heading", state.odometry.heading}};
  if (state.stalled) {
    told["stalled"] = true;
  }
  if (state.bumpedAhead) {
    told["ahead"] = true;
  }
  if (state.bumpedBehind) {
    told["behind"] = true;
  }
  if (!state.halt.empty()) {
    told["halt"] = state.halt;
  }
  if (!state.sonar.empty()) {
    told["sonar"] = sonarJson(state.sonar);
  }
  BaseState moved = state;
  moved.stamp += m_epoch;
  add(at, {{}, moved});
  return told;
}

json TickEncoder::tell(Time at, const std::optional<Scan> &scan)
{
  if (!scan) {
    return {};
  }
  if (m_scan && same(*scan, *m_scan)) {
    return kAgain;
  }
  m_scan = scan;
  Scan moved = *scan;
  moved.stamp += m_epoch;
  add(at, {{}, moved});
  return json::array({toJson(scan->stamp), scan->angleMin, scan->angleStep, scan->rangeMax});
}

json TickEncoder::tell(Time at, const std::optional<Frame> &frame)
{
  if (!frame) {
    return {};
  }
  if (frame->image.empty()) {
    return json::object({{kLost, toJson(frame->stamp)}});
  }
  // RecordingDevices give the same picture for the same one.
  if (m_frame && m_frame->stamp == frame->stamp && m_frame->image.data == frame->image.data) {
    return kAgain;
  }
  m_frame = frame;
  add(at, {{}, Frame{frame->stamp + m_epoch, frame->image}});
  return toJson(frame->stamp);
}

std::vector<BagMessage> TickEncoder::encode(const Tick &tick)
{
  m_messages.clear();
  const Time begin = tick.begin();
  json rest = restOf(tick);
  for (const BaseState &state : tick.states) {
    rest["states"].push_back(tell(begin, state));
  }
  for (const std::optional<Scan> &scan : tick.scans) {
    rest["scans"].push_back(tell(begin, scan));
  }
  for (const std::optional<Frame> &frame : tick.frames) {
    rest["frames"].push_back(tell(begin, frame));
  }
  for (const Twist2 &command : tick.commands) {
    add(begin, {{}, command});
  }
  for (const std::string &note : tick.notes) {
    add(begin, {{}, BagEvent{note}});
  }
  add(begin, {{}, BagEvent{rest.dump()}});
  return std::exchange(m_messages, {});
}

std::optional<Tick> TickDecoder::take(BagMessage message)
{
  if (auto *state = std::get_if<BaseState>(&message.what)) {
    m_states.push_back(std::move(*state));
  }
  else if (auto *scan = std::get_if<Scan>(&message.what)) {
    m_scans.push_back(std::move(*scan));
  }
  else if (auto *frame = std::get_if<Frame>(&message.what)) {
    m_frames.push_back(std::move(*frame));
  }
  else if (const auto *command = std::get_if<Twist2>(&message.what)) {
    m_commands.push_back(*command);
  }
  else if (const auto *event = std::get_if<BagEvent>(&message.what)) {
    const json told = json::parse(event->json);
    if (told.is_object() && told.value("event", "") == "tick") {
      return decode(told);
    }
  }
  return std::nullopt;
}

std::optional<Scan> TickDecoder::scan(const json &told)
{
  if (told.is_null()) {
    return std::nullopt;
  }
  if (told != kAgain) {
    Scan scan = std::move(m_scans.at(m_nextScan++));
    scan.stamp = timeFrom(told.at(0));
    scan.angleMin = told.at(1).get<double>();
    scan.angleStep = told.at(2).get<double>();
    scan.rangeMax = told.at(3).get<double>();
    m_scan = std::move(scan);
  }
  return m_scan;
}

std::optional<Frame> TickDecoder::frame(const json &told)
{
  if (told.is_null()) {
    return std::nullopt;
  }
  if (told.is_object()) {
    return Frame{timeFrom(told.at(kLost)), {}};
  }
  if (told != kAgain) {
    m_frame = Frame{timeFrom(told), m_frames.at(m_nextFrame++).image};
  }
  return m_frame;
}

Tick TickDecoder::decode(const json &told)
{
  Tick tick = tickFrom(told);
  std::size_t next = 0;
  for (const json &state : told.value("states", json::array())) {
    tick.states.push_back(stateFrom(state, m_states.at(next++)));
  }
  for (const json &each : told.value("scans", json::array())) {
    tick.scans.push_back(scan(each));
  }
  for (const json &each : told.value("frames", json::array())) {
    tick.frames.push_back(frame(each));
  }
  tick.commands = std::exchange(m_commands, {});
  m_states.clear();
  m_scans.clear();
  m_frames.clear();
  m_nextScan = 0;
  m_nextFrame = 0;
  return tick;
}

} // namespace homeward
