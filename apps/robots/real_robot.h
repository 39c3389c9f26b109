// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "robot_files.h"

#include <homeward/drivers/live_camera.h>
#include <homeward/drivers/protocol/aria_parameters.h>
#include <homeward/drivers/reconnect.h>
#include <homeward/pilot/motion.h>
#include <homeward/robot/laser_scanner.h>

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace homeward
{

/** The devices that a rig names, connected. */
class RealRobot
{
public:
  /** @param files of a rig with devices @throw DeviceError when one does not answer */
  explicit RealRobot(const RobotFiles &files);

  Devices devices();
  PioneerBase &base() { return *m_base; }
  LaserScanner &laser();
  LiveCamera &camera() { return *m_camera; }
  SteadyClock &clock() { return m_clock; }

  /** Why the base cannot be driven: it is lost or halted; empty when neither. */
  std::string baseFault();

  /**
   * Connects to a base that is lost again, see reconnect(); one that is not is left alone.
   * @return false when it was stopped
   * @throw DeviceError when it does not come back
   */
  bool bringBack(const ReconnectOptions &options, const std::atomic<bool> &stop,
                 const std::function<void(const std::string &)> &say);

private:
  PioneerBase::OpenLine m_openBase;
  SteadyClock m_clock;
  std::unique_ptr<LiveCamera> m_camera;
  std::unique_ptr<LaserScanner> m_laser; ///< null when the base has it
  std::unique_ptr<PioneerBase> m_base;
};

/** What the ARIA parameter file of a rig says; nothing without one. @throw ConfigError */
std::optional<AriaParameters> baseParameters(const RobotFiles &files);

/** Connects to the base of a rig alone. @throw DeviceError when it does not answer */
std::unique_ptr<PioneerBase> connectBase(const RobotFiles &files);

/** Connects to the laser on a line of its own; null when the base has it. @throw DeviceError */
std::unique_ptr<LaserScanner> connectLaser(const RobotFiles &files);

/** Opens the camera. @throw DeviceError, ConfigError */
std::unique_ptr<LiveCamera> connectCamera(const RobotFiles &files);

} // namespace homeward
