// SPDX-License-Identifier: GPL-3.0-or-later
#include "mount_drive.h"

#include <homeward/core/angle.h>
#include <homeward/core/error.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

namespace homeward
{
namespace
{

/** The drive while it lasts. */
class MountDrive
{
public:
  MountDrive(const Devices &devices, const RobotDescription &robot, const MirrorCamera &camera,
             const MountDriveOptions &options, const std::atomic<bool> &stop,
             const std::function<void(int)> &taken)
      : m_options(options), m_taken(taken), m_motion(devices, robot, {}, stop), m_set(camera)
  {}

  DataSet run()
  {
    m_motion.tick();
    turnRound();
    driveStraight();
    return std::move(m_set);
  }

private:
  /** Once round, then on to where the longest way is ahead: no step that pictures cannot follow. */
  void turnRound()
  {
    const double start = m_motion.pose().heading;
    std::vector<double> ways;
    const auto longest = [&] { return std::max_element(ways.begin(), ways.end()) - ways.begin(); };
    for (int i = 0; i <= m_options.turns + longest(); ++i) {
      turnTo(wrapAngle(start + 2.0 * kPi * i / m_options.turns));
      look();
      if (i < m_options.turns) {
        ways.push_back(wayAhead());
      }
    }
  }

  void turnTo(double heading)
  {
    if (!m_motion.turnTo(heading)) {
      throw RuntimeError(
          "no room to turn on the spot; put the robot where a metre is free round it");
    }
  }

  void driveStraight()
  {
    const Pose2 start = m_motion.pose();
    const auto along = [&] { return (start.inverse() * m_motion.pose()).x; };
    bool free = true;
    for (double next = m_options.step; free && next <= m_options.way; next += m_options.step) {
      while (free && along() < next) {
        m_motion.tick();
        free = m_motion.follow({m_options.speed, 0.0}, 0.0) == LocalDrive::State::Free;
      }
      look();
    }
    if (along() < m_options.least) {
      std::array<char, 160> text{};
      std::snprintf(text.data(), text.size(),
                    "only %.2f m of straight way are free, %.1f m are needed; put the robot where "
                    "there is more room",
                    along(), m_options.least);
      throw RuntimeError(text.data());
    }
  }

  /** A picture taken while the robot stands, with the odometry there. */
  void look()
  {
    m_motion.stop();
    Devices &devices = m_motion.devices();
    const Time since = devices.clock.now();
    std::optional<Frame> frame = devices.camera.grab();
    while (frame && frame->stamp < since) {
      m_motion.tick();
      m_motion.hold();
      frame = devices.camera.grab();
    }
    if (!frame) {
      throw DeviceError("the camera has no more pictures");
    }
    std::array<char, 32> name{};
    std::snprintf(name.data(), name.size(), "view_%03zu.png", m_set.size());
    m_set.add({name.data(), m_motion.pose(), "drive"}, frame->image);
    if (m_taken) {
      m_taken(static_cast<int>(m_set.size()));
    }
  }

  /** Metres to the first thing in the body's way. */
  double wayAhead() const
  {
    constexpr double kHalfWidth = 0.4; // metres
    const std::optional<Scan> &scan = m_motion.sight().scan;
    double nearest = scan ? static_cast<double>(scan->rangeMax) : 0.0;
    for (std::size_t i = 0; scan && i < scan->ranges.size(); ++i) {
      const double range = scan->ranges[i];
      const double angle = scan->angle(i);
      if (range * std::cos(angle) > 0.0 && std::abs(range * std::sin(angle)) < kHalfWidth) {
        nearest = std::min(nearest, range * std::cos(angle));
      }
    }
    return nearest;
  }

  MountDriveOptions m_options;
  const std::function<void(int)> &m_taken;
  Motion m_motion;
  DataSet m_set;
};

} // namespace

DataSet driveForMount(const Devices &devices, const RobotDescription &robot,
                      const MirrorCamera &camera, const MountDriveOptions &options,
                      const std::atomic<bool> &stop, const std::function<void(int)> &taken)
{
  return MountDrive(devices, robot, camera, options, stop, taken).run();
}

} // namespace homeward
