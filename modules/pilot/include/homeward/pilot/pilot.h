// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/unwarper.h>
#include <homeward/homing/homing_method.h>
#include <homeward/laser/open_directions.h>
#include <homeward/mission/command.h>
#include <homeward/mission/report.h>
#include <homeward/pilot/homing_run.h>
#include <homeward/pilot/motion.h>
#include <homeward/pilot/place_memory.h>

#include <functional>
#include <memory>
#include <string>

namespace homeward
{

/** Settings of the pilot. */
struct PilotOptions
{
  MotionOptions motion;                    ///< of the control loop
  PlaceMemory::Options places;             ///< of recognising places
  HomingRunOptions homing;                 ///< of driving home by sight
  OpenDirectionOptions directions;         ///< of directions worth exploring
  std::string homingMethod = "minwarping"; ///< see makeHomingMethod()
  PanoramaGeometry panorama;               ///< of the pictures that places are known by
  double leastSure = 0.9; ///< probability of standing at a node below which it was not reached
};

/** What the pilot sees, for people who look on. */
struct Sighting
{
  Panorama view;                   ///< gray
  std::optional<NodeId> goal;      ///< the node that it drives home to
  std::optional<HomeVector> home;  ///< from here to the goal; nothing when sight says nothing
  std::vector<PlaceMatch> matches; ///< places that the view may show, best first
};

/**
 * Carries out commands with sensors and wheels and says how it went. Single-threaded but for one
 * perception worker; safety and base run at every tick and never wait for it.
 */
class Pilot
{
public:
  /**
   * All arguments but the options must outlive the pilot.
   * @param stop see Motion
   * @param homing a method of the caller's own; null: the one that the options name
   */
  Pilot(const Devices &devices, const RobotDescription &robot, const MirrorCamera &camera,
        const PilotOptions &options, const std::atomic<bool> &stop,
        std::unique_ptr<HomingMethod> homing = nullptr);

  /** Does what the command says; the robot stands afterwards. @throw DeviceError when a device is
   * gone */
  Report execute(const Command &command);

  /**
   * The panorama taken by the last Survey, gray; or since then by a homing that has seen the place
   * anew, turned to the place's stored heading.
   */
  const Panorama &view() const { return m_view; }

  /** Metres driven so far, by odometry. */
  double travelled() const { return m_motion.travelled(); }

  /**
   * Makes a node known by sight, by this picture instead of an older one.
   * @param panorama as decoded from the map file
   */
  void remember(NodeId node, const Panorama &panorama);

  /** Which known places a picture may show, best first. @param panorama gray */
  std::vector<PlaceMatch> recognise(const Panorama &panorama) const
  {
    return m_places.recognise(panorama);
  }

  /** Called with every drive, homing and place decision, for logs; may be empty. */
  std::function<void(const std::string &)> trace;

  /** Called with every view that something is decided by, while it drives home from the thread of
   * its perception; may be empty. */
  std::function<void(const Sighting &)> onSight;

  /** Called when a Survey has taken its picture, before the robot turns; may be empty. */
  std::function<void()> onView;

private:
  Report run(const Survey &command);
  Report run(const DriveDirection &command);
  Report run(const Recognise &command);
  Report run(const HomeTo &command);
  Report run(const Finish &command);

  Panorama look();

  /** A camera that has shifted under its mirror shows it in its first pictures. */
  void followCamera(const cv::Mat &picture);
  Scan scanAllRound(const Pose2 &oMr);

  /** What sight says at a place where the robot has settled; its view is kept, if it can be turned.
   */
  std::optional<SeenAnew> seeAnew(NodeId node);

  /** Turns get lost on the wheels: the view tells again how the robot stands to the place left. */
  void alignWithPlace();

  Chord chordTo(const Pose2 &oMplace) const;

  /**
   * The robot stands at a place whose stored heading is `oMplace.heading`.
   * @param turned Motion::turned() when that was seen
   */
  void standAt(std::optional<NodeId> node, const Pose2 &oMplace, double turned);

  PilotOptions m_options;
  RobotDescription m_robot;
  Motion m_motion;
  MirrorCamera m_camera;
  std::vector<Eigen::Vector2d> m_rimShifts; ///< in the first pictures
  Unwarper m_unwarper;
  PlaceMemory m_places;
  std::unique_ptr<HomingMethod> m_homing;
  Panorama m_view;
  Pose2 m_oMplace;               ///< the node stood at last, heading as stored with it
  std::optional<NodeId> m_place; ///< its id; nothing until the surveyed place has become a node
  bool m_surveyed = false;       ///< the next node to be remembered is the place surveyed
  double m_leftAt = 0.0;         ///< travelled() when it was left
  double m_leftTurned = 0.0;     ///< turned() when its heading was seen last
};

} // namespace homeward
