// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "person.h"

#include <homeward/core/pose2.h>
#include <homeward/core/time.h>
#include <homeward/sim/free_space.h>

#include <vector>

namespace homeward
{

/**
 * People who walk about: along straight legs over floor where the robot fits, each at a speed of
 * their own between 0.5 and 1 m/s. They stop 0.6 m before the robot, and before one another and
 * what stands in their way; wait for 2 to 5 s, and then go elsewhere.
 */
class Walkers
{
public:
  /** As many of `count` as there is room for, none within 2 m of the robot. */
  Walkers(const FreeSpace &space, std::size_t count, const Pose2 &robot, std::uint64_t seed);

  /**
   * Everybody goes on for `step`.
   * @param inTheWay boxes that the floor plan does not know
   */
  void walk(Time now, Duration step, const Pose2 &robot,
            const std::vector<Eigen::AlignedBox3f> &inTheWay);

  /** Metres, world frame. */
  std::vector<Eigen::Vector2d> places() const;

  void addTo(Scene &scene) const;

private:
  struct Walker
  {
    Eigen::Vector2d at;
    Eigen::Vector2d goal;
    double speed; ///< m/s
    Time waitsUntil;
    PersonColours colours;
  };
  struct Around
  {
    Eigen::Vector2d robot;
    const std::vector<Eigen::AlignedBox3f> &boxes;
  };

  Eigen::Vector2d randomPlace();
  bool straightWay(const Eigen::Vector2d &from, const Eigen::Vector2d &to) const;
  bool mayStep(const Walker &walker, const Eigen::Vector2d &next, const Around &around) const;
  void turn(Walker &walker, Time now, const Around &around);

  const FreeSpace &m_space;
  const std::vector<Eigen::Vector2d> &m_cells;
  Random m_random;
  std::vector<Walker> m_walkers;
};

} // namespace homeward
