// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/error.h>
#include <homeward/record/tick.h>
#include <homeward/robot/clock.h>
#include <homeward/robot/laser_scanner.h>

#include <functional>
#include <memory>
#include <optional>

namespace homeward
{

/** Thrown by devices that replay, where the recording ends and the program goes on. */
class RecordingEnded : public RuntimeError
{
public:
  using RuntimeError::RuntimeError;
};

/** Where a program first told its robot something else than when it was recorded. */
struct Divergence
{
  Time at{};                      ///< robot time
  std::optional<Twist2> recorded; ///< nothing: no command
  std::optional<Twist2> now;      ///< nothing: no command
};

/**
 * Devices that answer as others did when RecordingDevices kept their ticks. A device that is asked
 * more often in a tick than it was says again what it said last. For one thread.
 */
class ReplayedDevices
{
public:
  /**
   * @param next the ticks in turn; nothing after the last
   * @param askToStop called where somebody asked for a stop
   */
  ReplayedDevices(std::function<std::optional<Tick>()> next, std::function<void()> askToStop);
  ~ReplayedDevices();

  /** The clock as it was. */
  Clock &clock();
  /** The base as it was. */
  MobileBase &base();
  /** The laser as it was. */
  LaserScanner &laser();
  /** The camera as it was. */
  ImageSource &camera();

  /** Robot time of the tick; a look at it that counts as no call. */
  Time now() const;

  /** Nothing while every command was as recorded. */
  std::optional<Divergence> divergence() const;

  /** When a picture was asked for that was not kept, for the first time; the one before was given.
   */
  std::optional<Time> missedPicture() const;

  /** Whether the program was recorded up to its end, and is there. */
  bool atEnd() const;

private:
  class Parts;
  std::unique_ptr<Parts> m_parts;
};

} // namespace homeward
