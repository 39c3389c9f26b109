// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/scan.h>
#include <homeward/robot/image_source.h>
#include <homeward/robot/mobile_base.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace homeward
{

/** What the clock said, so many times in a row. */
struct Instant
{
  Time at{};             ///< its answer
  std::size_t times = 1; ///< calls that had this answer
};

/** A device of the robot. */
enum class Device
{
  Base,
  Laser,
  Camera
};

/** A device failed when it was asked. */
struct DeviceFault
{
  Device device = Device::Base; ///< that failed
  std::size_t call = 0;         ///< calls of the tick before
  std::string what;             ///< the message of the DeviceError
};

/**
 * All that passed between a program and its robot from one Clock::sleepUntil() to the next, each
 * kind in its order.
 */
struct Tick
{
  std::vector<Instant> instants;            ///< answers of Clock::now()
  std::vector<bool> counted;                ///< answers of Clock::counts()
  std::vector<BaseState> states;            ///< answers of the base
  std::vector<std::optional<Scan>> scans;   ///< answers of the laser
  std::vector<std::optional<Frame>> frames; ///< one whose image is empty was not kept
  std::vector<std::optional<Time>> newest;  ///< answers of ImageSource::newest()
  std::vector<Twist2> commands;             ///< what the base was told
  std::vector<DeviceFault> faults;          ///< instead of answers
  std::vector<std::string> notes;           ///< what the program had to say, JSON
  /** Calls of this tick after which a stop was asked for; nothing: it was not yet. */
  std::optional<std::size_t> stopAfter;
  bool last = false; ///< the program ended; else it slept

  /** When it began: the first instant; of a tick without any, the zero of time. */
  Time begin() const { return instants.empty() ? Time{} : instants.front().at; }
};

} // namespace homeward
