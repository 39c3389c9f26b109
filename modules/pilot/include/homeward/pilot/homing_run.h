// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/homing/home_vector.h>
#include <homeward/mission/report.h>
#include <homeward/pilot/motion.h>
#include <homeward/pilot/vision_worker.h>
#include <homeward/servo/homing_servo.h>
#include <homeward/servo/range_scale.h>

#include <functional>
#include <optional>
#include <vector>

namespace homeward
{

/** Settings of a drive to a place by sight. */
struct HomingRunOptions
{
  double visionPeriod = 0.4;    ///< s between pictures
  double visionLatency = 0.2;   ///< s from a picture to its home vector
  double commandSeconds = 1.5;  ///< s after which a home vector is too old to drive on
  double arrivedProxy = 0.08;   ///< distance proxy of a place reached
  double closeProxy = 0.05;     ///< the same where it is to come closer
  double nearProxy = 0.16;      ///< within it, a home vector that swings round says "passed it"
  int reversals = 3;            ///< farther away it must swing round so often on the same spot, ...
  double swingConfidence = 0.6; ///< ... and be so sure
  double beside = 0.3; ///< metres, reckoned; a place within that nothing leads nearer to is reached
  double minConfidence = 0.06;    ///< home vectors below say nothing
  double lostSeconds = 8.0;       ///< s without a home vector that says something
  double leastGuess = 0.005;      ///< those from here on may point home when they agree: it goes on
  int searches = 3;               ///< there, so many times before it is lost
  double searchStep = 0.6;        ///< metres at a time
  double blockedSeconds = 3.0;    ///< s without a free way before it backs out, ...
  double headway = 0.15;          ///< metres it must have moved ...
  double headwaySeconds = 12.0;   ///< ... within so many seconds; else it is blocked too
  int retreats = 2;               ///< ... so many times, ...
  int detours = 2;                ///< ... then goes on ahead instead so many times, then gives up;
  int retreatsOnWay = 1;          ///< where the map says where the place is: no detours, and so ...
  double retreat = 0.6;           ///< metres it backs out along the way it came
  double detour = 0.6;            ///< metres ahead, wherever there is room
  double backOut = 0.3;           ///< metres straight back, where it has come no way yet
  double timeoutSeconds = 100.0;  ///< s altogether; ...
  double timeoutOnWay = 45.0;     ///< ... where the map says where the place is, at most so many
  double settledProxy = 0.02;     ///< distance proxy of a place reached as well as can be
  double settleSeconds = 20.0;    ///< s at most, to come from there to exactly there
  int steps = 2;                  ///< at most, by odometry, where it then still sees a way to go
  double alignSeconds = 10.0;     ///< s at most, to turn as the place was seen
  double departureDistance = 1.5; ///< metres over which a known departure bearing is trusted
  /** A home vector that is late is waited for: the same run comes out on a slow machine. Only where
   * time stands still meanwhile, in simulation. */
  bool waitForVision = true;
};

/**
 * One drive to a place by sight: home vectors come from perception at its own rate, the visual
 * servo turns them into velocities at every tick, the motion lets through what is safe.
 */
class HomingRun
{
public:
  /** Computes a home vector from a new picture; called on the perception thread. */
  using Look = std::function<std::optional<HomeVector>(const cv::Mat &picture)>;

  /** How it ended, and the stored heading of the place in the odometry frame when it arrived. */
  struct Result
  {
    HomingEnd end = HomingEnd::Lost; ///< why it ended
    double oPlaceHeading = 0.0;      ///< of the place, odometry frame, radians
    bool settled = false;            ///< within settledProxy of the place, turned as it was seen
  };

  /** `motion` and `servo` must outlive it. @param look takes a panorama */
  HomingRun(Motion &motion, HomingServo &servo, const HomingRunOptions &options, Look look);

  /**
   * Drives until it has arrived or cannot go on.
   * @param oDeparture heading to try first, odometry frame
   * @param exactly then comes closer
   * @param oPlace where the map has the place, metres, odometry frame: it must come nearer to there
   */
  Result run(std::optional<double> oDeparture, bool exactly = false,
             const std::optional<Eigen::Vector2d> &oPlace = std::nullopt);

  /** After an arrival: as near as sight tells, turned as the place was seen. */
  Result comeCloser();

private:
  struct Seen
  {
    HomeVector home;
    Pose2 oMr; ///< the robot when the picture was taken
  };

  /** Where the home vector pointed when the robot stood at a position, odometry frame. */
  struct Swing
  {
    double oDirection = 0.0;
    Eigen::Vector2d oPosition;
  };

  void perceive();
  void take(const HomeVector &seen, const Pose2 &oMr);
  void noteReversal(const HomeVector &home, const Pose2 &oMr);
  bool arrived() const;
  void settle();
  void align();
  bool settled() const;
  bool beside() const;
  void noteHeadway();
  void stepOver();
  void search();
  bool getOut();
  bool goAhead();
  void advance(double oBearing, double metres, double speed);
  Eigen::Vector2d rest() const; ///< way left, odometry frame, in distance proxies
  double oDirection(const Seen &seen) const;
  double placeHeading() const;
  Eigen::Vector2d wayHome(std::optional<double> oDeparture) const;
  void drive(const Eigen::Vector2d &oWay);

  Motion &m_motion;
  HomingServo &m_servo;
  HomingRunOptions m_options;
  Look m_look;
  VisionWorker<std::optional<HomeVector>> m_worker;
  std::vector<Seen> m_seen; ///< home vectors that said something, oldest first
  Pose2 m_pictureAt;
  Time m_nextPicture;
  Time m_lastSeen;
  Time m_lastFree;
  Time m_gotOn;                            ///< when it last had moved on
  Eigen::Vector2d m_gotOnAt;               ///< and where, odometry frame
  std::optional<Eigen::Vector2d> m_oPlace; ///< as the map has it
  double m_startTravelled = 0.0;
  RangeScale m_scale;
  std::vector<Seen> m_guesses; ///< home vectors that are unsure, since it stood
  int m_searches = 0;
  std::optional<Swing> m_swing; ///< when the home vector last swung round
  double m_hereProxy;           ///< distance proxy that says "here"
  double m_nearProxy;           ///< within it, a swing says "passed it"
  int m_inside = 0;             ///< home vectors in a row that say "here"
  int m_reversals = 0;          ///< swings on the same spot
  int m_retreats = 0;
  int m_detours = 0;
  bool m_settling = false; ///< distances are metres then: the way there has told their scale
  bool m_aligned = false;  ///< stands as the place was seen
};

} // namespace homeward
