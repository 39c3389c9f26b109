// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/camera_file.h>
#include <homeward/core/pose2.h>
#include <homeward/robot/clock.h>
#include <homeward/robot/image_source.h>
#include <homeward/robot/laser_scanner.h>
#include <homeward/robot/mobile_base.h>
#include <homeward/robot/rig.h>
#include <homeward/robot/robot_description.h>
#include <homeward/sim/free_space.h>
#include <homeward/sim/laser_model.h>
#include <homeward/sim/light_preset.h>
#include <homeward/sim/mirror_renderer.h>
#include <homeward/sim/scene.h>
#include <homeward/sim/wheeled_base.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

namespace homeward
{

/** What a Pioneer 3-AT can do at most, as data/robots/pioneer3at.yaml has it. */
inline constexpr Limits kPioneer3AtLimits{0.7, radians(140.0), 0.3, 0.5, radians(100.0)};

/** How a simulation is set up. */
struct SimulatorOptions
{
  std::uint64_t seed = 1;                    ///< of optics, slip and every noise
  LightPreset light = LightPreset::Day;      ///< day, night or another
  std::optional<Pose2> start = std::nullopt; ///< wMr; nothing: defaultStart()
  int threads = 2;                           ///< that render; the result does not depend on it
  bool exactOptics = false;                  ///< the mirror is as its file says (for data sets)
  LaserOptions laser = {};                   ///< of range, angle and noise
  Limits limits = kPioneer3AtLimits;         ///< of the base itself
  DriveErrors drive = {};                    ///< of wheels on the floor
  RenderOptions camera = {};                 ///< its `threads` is overruled by the one above
};

/** What only the simulator knows. */
struct Truth
{
  Pose2 pose;             ///< wMr
  double distance = 0.0;  ///< driven, metres
  int collisions = 0;     ///< times the body ran at more than 5 cm/s into what the laser could see
  int unseenContacts = 0; ///< the same, into what its plane misses
};

/**
 * A robot in a world behind the interfaces of the real one.
 *
 * Time passes only in Clock::sleepUntil(), in steps of 20 ms, so the clock may end up to one
 * step late. The same seed, options and calls give the same everything. A body that would touch the
 * world stands still instead (WheeledBase). Sensors answer for the instant they are asked at, and
 * the same when asked twice. A run into something counts once until the body has been free for 1 s
 * or is 10 cm away.
 */
class Simulator
{
public:
  /** In which the world moves on. */
  static constexpr Duration kStep = std::chrono::milliseconds(20);

  /**
   * @param scene the world; floor at z = 0
   * @param nominal what the robot believes of its camera; the true optics are drawn near it
   * @throw ConfigError, one line, when the start is outside the world, in a wall or in a space of
   * less than 1 m^2, or the robot fits nowhere
   */
  Simulator(const std::shared_ptr<const Scene> &scene, const RobotDescription &robot,
            const MirrorCamera &nominal, const SimulatorOptions &options = {});
  ~Simulator();
  Simulator(const Simulator &) = delete;
  Simulator &operator=(const Simulator &) = delete;

  /** Makes time pass. */
  Clock &clock();
  /** The wheels. */
  MobileBase &base();
  /** The laser. */
  LaserScanner &laser();
  /** The mirror camera. */
  ImageSource &camera();

  /** As it is now. */
  Truth truth() const;

  /** Of the world as it was first: reachable from the start; lines of sight at the height of the
   * mirror's focus. */
  const FreeSpace &freeSpace() const;

  /**
   * Carries the robot to another place; its odometry does not notice.
   * @throw ConfigError as the constructor does; the robot then stays where it was
   */
  void kidnap(const Pose2 &wMr);

  /**
   * The building becomes another, furniture moved for example: laser, sonar, body and camera meet
   * that from now on. Everything else goes on, and freeSpace() stays that of the first.
   * @throw ConfigError when the robot would stand in it; nothing has changed then
   */
  void change(const std::shared_ptr<const Scene> &scene);

  /**
   * Things stand in the world besides, people for example, instead of those put before. Quick: the
   * building's search trees stay.
   * @param things their lights do not count; null: nothing
   * @throw ConfigError when the robot would stand in one; nothing has changed then
   */
  void put(const std::shared_ptr<const Scene> &things);

  /** Called before each step of the world with its time; the place to change it from. */
  std::function<void(Time)> onStep;

private:
  class Impl;
  std::unique_ptr<Impl> m_impl;
};

} // namespace homeward
