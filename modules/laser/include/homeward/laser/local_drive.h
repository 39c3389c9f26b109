// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/angle.h>
#include <homeward/laser/clearance.h>
#include <homeward/laser/safety.h>

#include <optional>
#include <vector>

namespace homeward
{

/**
 * Drives towards a bearing and round what is in the way, forward or turning on the spot, without
 * memory: the same points and wishes give the same twist.
 *
 * Every 5 degrees around the desired bearing, up to maxDeflection, a direction is scored by
 *
 *     (sum over margins m of weight_m * free travel with the footprint grown by m) / horizon
 *         * (1 - 0.6 |deflection| / 90 deg) - turnCost * |turn to it|
 *
 * and the best one that can be taken is: along a gentle arc when that is free, else after a turn on
 * the spot, always when it is more than turnFirst away. As no direction leads away from the goal,
 * the robot comes nearer or gives up; the cost of turning keeps it on the side it has chosen. After
 * the dynamic window \cite Fox1997 and the vector field histogram \cite Borenstein1991, with the
 * true footprint.
 */
class LocalDrive
{
public:
  /** How it drives. */
  struct Options
  {
    double maxSpeed = 0.5;                ///< m/s
    double maxTurnRate = 1.0;             ///< rad/s
    double margin = 0.10;                 ///< metres preferred around the footprint
    double minMargin = 0.05;              ///< metres kept around it in any case
    double minTravel = 0.30;              ///< metres a direction must be free for
    double maxDeflection = radians(80.0); ///< rad from the desired bearing
    double turnFirst = radians(60.0);     ///< rad from which the robot turns on the spot
    double lookAhead = 4.0;               ///< s of driving that are looked at, ...
    double minHorizon = 0.6;              ///< ... at least so many metres, ...
    double maxHorizon = 2.0;              ///< ... and at most so many
    double turnCost = 0.17;               ///< score per radian
    AvoidOptions safety;                  ///< nothing is commanded that avoid() would change
  };

  /** What became of the wish. */
  enum class State
  {
    Free,      ///< goes where it was asked to
    Deflected, ///< goes round something
    Blocked    ///< no way towards the bearing; stands
  };

  /** What to do now. */
  struct Decision
  {
    Twist2 twist;                 ///< to command
    State state = State::Blocked; ///< what that is for
  };

  /** @throw LogicError for options out of bounds, naming the option */
  LocalDrive(const Footprint &footprint, const Options &options);

  /**
   * The twist for this tick. Never backwards.
   * @param points obstacles in the robot's frame, metres: laser, remembered, sonar
   * @param desiredBearing of the goal in the robot's frame, rad
   * @param desiredSpeed m/s; also says how far ahead it is worth looking
   * @throw LogicError when bearing or speed is not finite or the speed is negative
   */
  Decision choose(const std::vector<Eigen::Vector2d> &points, double desiredBearing,
                  double desiredSpeed) const;

private:
  struct Way;
  struct Surroundings;

  Surroundings look(const std::vector<Eigen::Vector2d> &points, double desiredSpeed) const;
  Way score(const Surroundings &around, double turn, double deflection) const;
  std::vector<Way> ways(const Surroundings &around, double bearing) const;
  std::optional<double> spotTurn(const Surroundings &around, double turn) const;
  double arcTravel(const Surroundings &around, double curvature, double turn, double margin) const;
  std::optional<Twist2> alongArc(const Surroundings &around, const Way &way, double margin,
                                 double speed) const;
  std::optional<Twist2> onTheSpot(const Surroundings &around, const Way &way) const;
  std::optional<Twist2> take(const Surroundings &around, const Way &way, double speed) const;

  Footprint m_footprint;
  Options m_options;
};

} // namespace homeward
