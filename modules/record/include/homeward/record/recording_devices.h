// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/record/tick.h>
#include <homeward/robot/clock.h>
#include <homeward/robot/laser_scanner.h>

#include <atomic>
#include <functional>
#include <memory>

namespace homeward
{

/**
 * Devices that pass everything on and keep what passed. Whoever uses them is told nothing else than
 * without them. For one thread.
 */
class RecordingDevices
{
public:
  /** Takes each tick when it is over. */
  using Keep = std::function<void(Tick)>;

  /** @param stop what stops the program; all arguments outlive the object */
  RecordingDevices(Clock &clock, MobileBase &base, LaserScanner &laser, ImageSource &camera,
                   const std::atomic<bool> &stop, Keep keep);
  ~RecordingDevices();

  /** The clock to give to the mission; each call is kept. */
  Clock &clock();
  /** The base to give to the mission; each call is kept. */
  MobileBase &base();
  /** The laser to give to the mission; each call is kept. */
  LaserScanner &laser();
  /** The camera to give to the mission; each call is kept. */
  ImageSource &camera();

  /** Keeps something that the program has to say. @param json one value */
  void note(std::string json);

  /** Keeps the last tick; what passes afterwards is kept no more. */
  void finish();

private:
  class Parts;
  std::unique_ptr<Parts> m_parts;
};

} // namespace homeward
