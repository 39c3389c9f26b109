// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mission_robot.h"

#include <memory>
#include <string>

namespace homeward
{

/** What pioneer-sim knows and says at `/truth`; for evaluation only. */
class RemoteTruth
{
public:
  /** @param url such as http://127.0.0.1:8102 @throw DeviceError when nobody answers there */
  RemoteTruth(const std::string &url, const RobotFiles &files);

  const SimulatedWorld &world() const { return m_world; }

  /** Asks. @throw DeviceError when the simulator is gone */
  Truth now() const;

  const FreeSpace &freeSpace();

private:
  std::string m_url;
  const RobotFiles &m_files;
  SimulatedWorld m_world;
  Pose2 m_start;
  std::unique_ptr<Simulator> m_simulator; ///< the same world, to judge by
};

} // namespace homeward
