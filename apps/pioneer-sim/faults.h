// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <string>
#include <utility>

namespace homeward
{

/** What is to go wrong, for those who test what their robot does then. Any thread may set it. */
struct Faults
{
  std::atomic<bool> silentBase{false};   ///< sends no packets; it still obeys
  std::atomic<bool> halfPackets{false};  ///< the base sends the first half of each packet only
  std::atomic<bool> badChecksums{false}; ///< every packet of the base arrives with a wrong checksum
  std::atomic<bool> garbage{false};      ///< the base sends garbage instead of packets
  std::atomic<bool> wrongBaud{false};    ///< the base's line is garbled both ways
  std::atomic<bool> deafBase{false};     ///< takes no bytes from its line; it still sends
  std::atomic<bool> heldWheels{false};   ///< they do not turn, and the base says so
  std::atomic<bool> silentLaser{false};  ///< neither telegrams nor laser packets
  std::atomic<bool> blindLaser{false};   ///< its window is covered: it sends readings, none known
  std::atomic<bool> upsideDown{false};   ///< the laser runs clockwise
  std::atomic<bool> silentCamera{false}; ///< sends no pictures
  std::atomic<bool> frozenCamera{false}; ///< sends the same picture again and again
  std::atomic<bool> cutCamera{false};    ///< its stream ends in the middle of a picture
  std::atomic<bool> lateCamera{false};   ///< its pictures queue up for a second on their way
  std::atomic<bool> emergencyStop{false}; ///< somebody holds its emergency stop pressed
  std::atomic<bool> motorsButton{false};  ///< somebody keeps its motors switched off
  std::atomic<bool> frontBumper{false};   ///< something presses it
  std::atomic<bool> rearBumper{false};    ///< likewise

  /** The fault of that name; null for any other. */
  std::atomic<bool> *find(const std::string &name)
  {
    for (const auto &[known, fault] : kNames) {
      if (name == known) {
        return &(this->*fault);
      }
    }
    return nullptr;
  }

  /** All names, for a message. */
  static std::string names()
  {
    std::string all;
    for (const auto &[known, fault] : kNames) {
      all += (all.empty() ? "" : ", ") + std::string(known);
    }
    return all;
  }

private:
  static constexpr std::pair<const char *, std::atomic<bool> Faults::*> kNames[] = {
      {"base", &Faults::silentBase},       {"half", &Faults::halfPackets},
      {"checksum", &Faults::badChecksums}, {"garbage", &Faults::garbage},
      {"baud", &Faults::wrongBaud},        {"deaf", &Faults::deafBase},
      {"stall", &Faults::heldWheels},      {"laser", &Faults::silentLaser},
      {"blind", &Faults::blindLaser},      {"upside_down", &Faults::upsideDown},
      {"camera", &Faults::silentCamera},   {"frozen", &Faults::frozenCamera},
      {"cut", &Faults::cutCamera},         {"late", &Faults::lateCamera},
      {"estop", &Faults::emergencyStop},   {"motors", &Faults::motorsButton},
      {"front", &Faults::frontBumper},     {"rear", &Faults::rearBumper}};
};

} // namespace homeward
