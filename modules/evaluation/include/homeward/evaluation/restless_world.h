// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/sim/simulator.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace homeward
{

/** What goes on in a world while the robot is at work. */
struct Restlessness
{
  std::size_t people = 0;     ///< who walk about
  double moveFurniture = 0.8; ///< metres that chairs are moved from their places; 0: they stay
  double calm = 120.0;        ///< mean time between two moves of all chairs, simulated s
};

/**
 * People walk about in a simulated world and chairs get moved, as long as this lives.
 *
 * People are boxes of a person's size; they walk along straight legs at 0.5 to 1 m/s, stop 0.6 m
 * before the robot, wait, and go elsewhere. Chairs (changeScene()) never move to within 0.6 m of
 * the robot's middle or of a person. Simulated time, the robot's way and the seed decide
 * everything. The simulator's freeSpace() stays that of the quiet world.
 */
class RestlessWorld
{
public:
  /**
   * Takes the simulator's onStep.
   * @param simulator outlives this
   * @param scene of the simulator, as it is when quiet
   */
  RestlessWorld(Simulator &simulator, std::shared_ptr<const Scene> scene,
                const Restlessness &restlessness, std::uint64_t seed);
  ~RestlessWorld();
  RestlessWorld(const RestlessWorld &) = delete;
  RestlessWorld &operator=(const RestlessWorld &) = delete;

  /**
   * Things stand in the world besides, instead of those put before; people do not walk into them.
   * Simulator::put() would take the people away.
   * @param things null: nothing
   * @throw ConfigError when the robot would stand in one; nothing has changed then
   */
  void put(const std::shared_ptr<const Scene> &things);

  /** Where the people are, metres, world frame. */
  std::vector<Eigen::Vector2d> people() const;

  /** How often the chairs have been moved. */
  int moves() const;

private:
  class Impl;
  std::unique_ptr<Impl> m_impl;
};

} // namespace homeward
