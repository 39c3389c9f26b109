// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/pilot/pilot.h>

#include <homeward/camera/rim.h>
#include <homeward/camera/turned.h>
#include <homeward/core/error.h>
#include <homeward/laser/half_scans.h>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstdio>

namespace homeward
{
namespace
{

/** Whether so much of a gray picture is white that it says nothing of where it was taken. */
bool overExposed(const cv::Mat &gray)
{
  constexpr int kWhite = 250;
  constexpr double kMost = 0.3; // share of the picture
  return cv::countNonZero(gray >= kWhite) > kMost * static_cast<double>(gray.total());
}

/** Metres by which the odometry of a way and what the map has of it may differ. */
double farFrom(double distance)
{
  return 0.5 + 0.25 * distance;
}

/** How far a scan reaches in a direction or close beside it, metres; radians from the robot's
 * front.
 */
double reachOf(const Scan &scan, const Eigen::Isometry3d &rMl, double bearing)
{
  constexpr double kBeside = radians(3.0);
  const Scan seen = joinScans({{scan, Pose2{}}}, rMl);
  double farthest = 0.0;
  for (std::size_t i = 0; i < seen.ranges.size(); ++i) {
    if (std::abs(wrapAngle(seen.angle(i) - bearing)) <= kBeside && !std::isnan(seen.ranges[i])) {
      farthest = std::max(farthest, static_cast<double>(seen.ranges[i]));
    }
  }
  return farthest;
}

} // namespace

Pilot::Pilot(const Devices &devices, const RobotDescription &robot, const MirrorCamera &camera,
             const PilotOptions &options, const std::atomic<bool> &stop,
             std::unique_ptr<HomingMethod> homing)
    : m_options(options), m_robot(robot), m_motion(devices, robot, options.motion, stop),
      m_camera(camera), m_unwarper(camera, options.panorama), m_places(options.places),
      m_homing(homing ? std::move(homing) : makeHomingMethod(options.homingMethod))
{}

Report Pilot::execute(const Command &command)
{
  try {
    return std::visit([this](const auto &what) { return run(what); }, command);
  }
  catch (const StopRequested &) {
    return Interrupted{};
  }
}

Panorama Pilot::look()
{
  constexpr int kPatience = 50; // ticks
  const Devices &devices = m_motion.devices();
  const Time standing = devices.clock.now();
  std::optional<Frame> frame = devices.camera.grab();
  // A camera that runs by itself may still show where the robot drove a moment ago.
  for (int i = 0; i < kPatience && frame && frame->stamp < standing; ++i) {
    m_motion.hold();
    m_motion.tick();
    frame = devices.camera.grab();
  }
  if (!frame || frame->stamp < standing) {
    throw DeviceError("the camera has no more pictures");
  }
  followCamera(frame->image);
  Panorama panorama = m_unwarper.unwarp(frame->image);
  if (panorama.image.channels() == 3) {
    cv::cvtColor(panorama.image, panorama.image, cv::COLOR_BGR2GRAY);
  }
  return panorama;
}

void Pilot::followCamera(const cv::Mat &picture)
{
  constexpr std::size_t kEnough = 15;
  if (m_rimShifts.size() >= kEnough) {
    return;
  }
  if (const auto shift = rimShift(picture, m_camera)) {
    m_rimShifts.push_back(*shift);
    m_unwarper = Unwarper(followRim(m_camera, m_rimShifts), m_options.panorama);
  }
}

void Pilot::alignWithPlace()
{
  constexpr double kSure = 0.15;
  if (!m_place) {
    return;
  }
  const auto home = m_homing->compute(look(), m_places.snapshot(*m_place));
  if (!home || home->confidence < kSure) {
    return;
  }
  const double heading = wrapAngle(m_motion.pose().heading - home->headingChange);
  if (m_motion.learnTurns(m_motion.turned() - m_leftTurned,
                          wrapAngle(m_oMplace.heading - heading))) {
    m_oMplace.heading = heading;
    m_leftTurned = m_motion.turned();
  }
}

Chord Pilot::chordTo(const Pose2 &oMplace) const
{
  const Pose2 there = m_oMplace.inverse() * oMplace;
  const Pose2 back = oMplace.inverse() * m_oMplace;
  return {there.translation().norm(), m_motion.travelled() - m_leftAt, std::atan2(there.y, there.x),
          std::atan2(back.y, back.x)};
}

void Pilot::remember(NodeId node, const Panorama &panorama)
{
  if (m_places.knows(node)) {
    m_places.replace(node, panorama);
    return;
  }
  m_places.add(node, panorama);
  if (m_surveyed) {
    m_place = node;
    m_surveyed = false;
  }
}

std::optional<SeenAnew> Pilot::seeAnew(NodeId node)
{
  const Panorama current = look();
  const auto home = MinWarping(kThoroughWarping).compute(current, m_places.snapshot(node));
  if (overExposed(current.image) || !home) {
    return std::nullopt;
  }
  m_view = turned(current, -home->headingChange);
  return m_places.seeAnew(node, current);
}

void Pilot::standAt(std::optional<NodeId> node, const Pose2 &oMplace, double turned)
{
  m_place = node;
  m_surveyed = !node;
  m_oMplace = oMplace;
  m_leftAt = m_motion.travelled();
  m_leftTurned = turned;
}

Report Pilot::run(const Survey &)
{
  m_motion.stop();
  m_view = look();
  if (onView) {
    onView();
  }
  const Pose2 oMr = m_motion.pose();
  const double turned = m_motion.turned();
  Surveyed report;
  report.chord = chordTo(oMr);
  report.directions = findOpenDirections(scanAllRound(oMr), m_options.directions);
  standAt(std::nullopt, oMr, turned);
  return report;
}

Scan Pilot::scanAllRound(const Pose2 &oMr)
{
  const Scan front = *m_motion.tick().scan;
  const Pose2 oMfront = m_motion.poseAt(front.stamp);
  std::vector<PlacedScan> scans{{front, oMr.inverse() * oMfront}};
  const double seen = front.angleStep * static_cast<double>(front.ranges.size());
  if (seen < 2.0 * kPi - 2.0 * front.angleStep) {
    m_motion.turnTo(wrapAngle(oMr.heading + kPi));
    const Scan back = *m_motion.tick().scan;
    scans.push_back({back, oMr.inverse() * m_motion.poseAt(back.stamp)});
  }
  return joinScans(scans, m_robot.rMl);
}

Report Pilot::run(const DriveDirection &command)
{
  constexpr double kPatience = 5.0;
  constexpr double kBlockedSeconds = 1.5;
  const double oBearing = wrapAngle(m_oMplace.heading + command.bearing);
  m_motion.turnTo(oBearing);
  const Pose2 start = m_motion.pose();
  const Eigen::Vector2d oAhead(std::cos(oBearing), std::sin(oBearing));
  const Eigen::Vector2d oGoal = start.translation() + command.distance * oAhead;
  double best = command.distance;
  Time bestAt = m_motion.devices().clock.now();
  Time free = bestAt;
  Driven report;
  while (true) {
    const std::optional<Scan> &scan = m_motion.tick().scan;
    const Time now = m_motion.devices().clock.now();
    const Eigen::Vector2d oLeft = oGoal - m_motion.pose().translation();
    const double left = oLeft.norm();
    if (left < 0.1 || oLeft.dot(oAhead) < 0.0) {
      break;
    }
    if (left < best - 0.05) {
      best = left;
      bestAt = now;
    }
    if (toSeconds(now - bestAt) > kPatience || toSeconds(now - free) > kBlockedSeconds) {
      report.blocked = true;
      report.seenAhead = reachOf(*scan, m_robot.rMl, wrapAngle(oBearing - m_motion.pose().heading));
      break;
    }
    const double bearing = wrapAngle(std::atan2(oLeft.y(), oLeft.x()) - m_motion.pose().heading);
    const double speed = std::clamp(left, 0.1, m_options.motion.maxSpeed);
    if (m_motion.steer(bearing, speed, Motion::Room::Ample) != LocalDrive::State::Blocked) {
      free = now;
    }
  }
  m_motion.stop();
  alignWithPlace();
  report.chord = chordTo(m_motion.pose());
  if (trace) {
    char text[80];
    std::snprintf(text, sizeof text, "drive %.0f deg: %.1f m%s", degrees(command.bearing),
                  report.chord.distance, report.blocked ? ", blocked" : "");
    trace(text);
  }
  return report;
}

Report Pilot::run(const Recognise &)
{
  m_motion.stop();
  const Panorama view = look();
  Recognised report{m_places.recognise(view)};
  if (onSight) {
    onSight({view, std::nullopt, std::nullopt, report.matches});
  }
  if (trace) {
    std::string line = "recognise";
    for (std::size_t i = 0; i < std::min<std::size_t>(report.matches.size(), 3); ++i) {
      const PlaceMatch &match = report.matches[i];
      char text[80];
      std::snprintf(text, sizeof text, "  %lld: p %.2f%s, %.0f",
                    static_cast<long long>(match.node.value), match.probability,
                    match.verified ? " verified" : "", match.dissimilarity);
      line += text;
    }
    trace(line);
  }
  return report;
}

Report Pilot::run(const HomeTo &command)
{
  const Panorama &snapshot = m_places.snapshot(command.node);
  HomingServo servo(m_robot.rMp, {});
  HomingRunOptions how = m_options.homing;
  how.arrivedProxy = command.closely ? how.closeProxy : how.arrivedProxy;
  how.retreatsOnWay = command.again ? 0 : how.retreatsOnWay;
  how.timeoutSeconds = command.patience.value_or(how.timeoutSeconds);
  HomingRun homing(
      m_motion, servo, how,
      [this, &snapshot, node = command.node](const cv::Mat &picture) -> std::optional<HomeVector> {
        Panorama current = m_unwarper.unwarp(picture);
        if (current.image.channels() == 3) {
          cv::cvtColor(current.image, current.image, cv::COLOR_BGR2GRAY);
        }
        std::optional<HomeVector> home;
        if (!overExposed(current.image)) {
          home = m_homing->compute(current, snapshot);
        }
        if (onSight) {
          onSight({current, node, home, {}});
        }
        return home;
      });
  const double travelledBefore = m_motion.travelled();
  const Time begin = m_motion.devices().clock.now();
  std::optional<double> oDeparture;
  if (command.departure) {
    oDeparture = wrapAngle(m_oMplace.heading + *command.departure);
  }
  std::optional<Eigen::Vector2d> oPlace;
  if (command.way) {
    const double oBearing = m_oMplace.heading + command.way->bearing;
    oPlace = m_oMplace.translation() +
             command.way->distance * Eigen::Vector2d(std::cos(oBearing), std::sin(oBearing));
  }
  HomingRun::Result result =
      homing.run(oDeparture, command.exactly, command.direct ? oPlace : std::nullopt);
  std::optional<double> sure;
  const bool elsewhere =
      oPlace && (m_motion.pose().translation() - *oPlace).norm() > farFrom(command.way->distance);
  if (result.end == HomingEnd::Arrived && (command.surely || elsewhere)) {
    sure = m_places.standingAt(command.node, look());
    if (*sure < m_options.leastSure && !command.exactly) {
      result = homing.comeCloser();
      sure = m_places.standingAt(command.node, look());
    }
    if (*sure < m_options.leastSure) {
      // It looks alike; or what stands in the way hides it.
      result.end = command.direct ? HomingEnd::Blocked : HomingEnd::Lost;
    }
  }
  const Pose2 oMplace{m_motion.pose().x, m_motion.pose().y, result.oPlaceHeading};
  const Time end = m_motion.devices().clock.now();
  Homed report{result.end, chordTo(oMplace), toSeconds(end - begin), toSeconds(end)};
  if (command.seeAnew && result.end == HomingEnd::Arrived && result.settled) {
    report.seen = seeAnew(command.node);
  }
  if (trace) {
    char text[80];
    std::snprintf(text, sizeof text, "home to %lld: %s after %.1f m",
                  static_cast<long long>(command.node.value), name(result.end),
                  m_motion.travelled() - travelledBefore);
    std::string line = text;
    if (sure) {
      std::snprintf(text, sizeof text, ", sure %.3f", *sure);
      line += text;
    }
    if (report.seen) {
      std::snprintf(text, sizeof text, ", seen anew: sure %.3f%s, change %.3f", report.seen->sure,
                    report.seen->likeliest ? "" : ", not the likeliest", report.seen->change);
      line += text;
    }
    trace(line);
  }
  if (result.end == HomingEnd::Arrived) {
    standAt(command.node, oMplace, m_motion.turned());
  }
  return report;
}

Report Pilot::run(const Finish &)
{
  m_motion.stop();
  return Interrupted{};
}

} // namespace homeward
