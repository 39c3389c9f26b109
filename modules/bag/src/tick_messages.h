// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/bag/bag_message.h>
#include <homeward/record/tick.h>

#include <nlohmann/json.hpp>

#include <vector>

namespace homeward
{

/** Makes messages of ticks. A scan or a picture that was given before is told and not repeated. */
class TickEncoder
{
public:
  /** @param epoch ROS time at zero of robot time */
  explicit TickEncoder(Duration epoch) : m_epoch(epoch) {}

  /** The messages of a tick; the last is its event. */
  std::vector<BagMessage> encode(const Tick &tick);

  /** An event of its own. */
  BagMessage event(const nlohmann::json &what);

  /** A new bag begins: what is told next is told in full. */
  void beginBag();

private:
  void add(Time at, BagMessage message);
  nlohmann::json tell(Time at, const BaseState &state);
  nlohmann::json tell(Time at, const std::optional<Scan> &scan);
  nlohmann::json tell(Time at, const std::optional<Frame> &frame);
  Time later(Time at);

  Duration m_epoch;
  Time m_last{};
  std::optional<Scan> m_scan;
  std::optional<Frame> m_frame;
  std::vector<BagMessage> m_messages;
};

/** Makes ticks of messages again. */
class TickDecoder
{
public:
  /** Takes a message; the tick that ends with it. @throw std::exception when it says nonsense */
  std::optional<Tick> take(BagMessage message);

private:
  Tick decode(const nlohmann::json &told);
  std::optional<Scan> scan(const nlohmann::json &told);
  std::optional<Frame> frame(const nlohmann::json &told);

  std::vector<BaseState> m_states;
  std::vector<Scan> m_scans;
  std::vector<Frame> m_frames;
  std::vector<Twist2> m_commands;
  std::size_t m_nextScan = 0;  ///< of m_scans
  std::size_t m_nextFrame = 0; ///< of m_frames
  std::optional<Scan> m_scan;
  std::optional<Frame> m_frame;
};

} // namespace homeward
