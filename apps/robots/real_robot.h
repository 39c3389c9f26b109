// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "robot_files.h"

#include <homeward/drivers/live_camera.h>
#include <homeward/drivers/pioneer_base.h>
#include <homeward/pilot/motion.h>
#include <homeward/robot/laser_scanner.h>

#include <memory>

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

private:
  SteadyClock m_clock;
  std::unique_ptr<LiveCamera> m_camera;
  std::unique_ptr<LaserScanner> m_laser; ///< null when the base has it
  std::unique_ptr<PioneerBase> m_base;
};

/** Connects to the base of a rig alone. @throw DeviceError when it does not answer */
std::unique_ptr<PioneerBase> connectBase(const RobotFiles &files);

/** Connects to the laser on a line of its own; null when the base has it. @throw DeviceError */
std::unique_ptr<LaserScanner> connectLaser(const RobotFiles &files);

/** Opens the camera. @throw DeviceError, ConfigError */
std::unique_ptr<LiveCamera> connectCamera(const RobotFiles &files);

} // namespace homeward
