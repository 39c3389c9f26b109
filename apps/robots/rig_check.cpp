// SPDX-License-Identifier: GPL-3.0-or-later
#include "rig_check.h"

#include <homeward/camera/unwarper.h>
#include <homeward/core/error.h>
#include <homeward/homing/visual_compass.h>
#include <homeward/pilot/turn_witness.h>

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <functional>
#include <limits>
#include <opencv2/imgproc.hpp>

namespace homeward
{
namespace
{

constexpr double kTurn = radians(30.0);
constexpr double kAdvance = 0.15; // metres
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

std::string line(const char *format, ...) __attribute__((format(printf, 1, 2)));

std::string line(const char *format, ...)
{
  char text[200];
  std::va_list values;
  va_start(values, format);
  std::vsnprintf(text, sizeof text, format, values);
  va_end(values);
  return text;
}

/** Instants at which something new came. */
class Arrivals
{
public:
  void note(Time stamp)
  {
    if (m_last && stamp > *m_last) {
      m_longest = std::max(m_longest, toSeconds(stamp - *m_last));
      m_sum += toSeconds(stamp - *m_last);
      ++m_count;
    }
    m_last = stamp;
  }

  /** A line on the rate; bad when gaps are longer than twice the period that the rig says. */
  Finding finding(const std::string &device, double period, const std::string &more) const
  {
    if (m_count == 0) {
      return {device, false, "is silent"};
    }
    const double mean = m_sum / m_count;
    const bool good = mean < 1.5 * period;
    return {device, good,
            line("%.1f a second, longest gap %.2f s", 1.0 / mean, m_longest) +
                (good ? "" : line("; the rig says every %.2f s", period)) + more};
  }

private:
  std::optional<Time> m_last;
  double m_longest = 0.0;
  double m_sum = 0.0;
  int m_count = 0;
};

/** Calls `look` for so long, a hundred times a second. */
void listen(SteadyClock &clock, double seconds, const std::function<void()> &look)
{
  const Time end = clock.now() + fromSeconds(seconds);
  while (clock.now() < end) {
    look();
    clock.sleepUntil(clock.now() + std::chrono::milliseconds(10));
  }
}

/** How fast the line to a base is. */
std::string lineSpeed(const PioneerBase &base, const BaseLink &link)
{
  if (base.baud() == 0) {
    return "";
  }
  std::error_code error; // gone since: then its name must do
  const std::filesystem::path device = std::filesystem::weakly_canonical(link.address, error);
  return device.string().starts_with("/dev/pts/")
             ? ", over a pseudo-terminal, where any speed is right"
             : line(", at %d baud", base.baud());
}

Finding hearBase(RealRobot &robot, const BaseLink &link, double seconds)
{
  Arrivals arrivals;
  listen(robot.clock(), seconds, [&] { arrivals.note(robot.base().state().stamp); });
  const BaseState state = robot.base().state();
  const auto echoes = std::count_if(state.sonar.begin(), state.sonar.end(),
                                    [](const auto &echo) { return !std::isnan(echo.range); });
  Finding finding = arrivals.finding(
      "base", link.period,
      line(", '%s' (%s), %zu sonars, %td with an echo", robot.base().identity().name.c_str(),
           robot.base().identity().subclass.c_str(), state.sonar.size(), echoes) +
          lineSpeed(robot.base(), link));
  for (const auto &[is, what] : {std::pair{state.stalled, "its wheels are stalled"},
                                 std::pair{state.bumpedAhead, "its front bumper is pressed"},
                                 std::pair{state.bumpedBehind, "its rear bumper is pressed"},
                                 std::pair{!state.halt.empty(), state.halt.c_str()}}) {
    if (is) {
      finding.good = false;
      finding.text += std::string("; ") + what;
    }
  }
  return finding;
}

/** Whose units the base is driven with. */
Finding hearUnits(RealRobot &robot, const RobotFiles &files)
{
  const std::string &subclass = robot.base().identity().subclass;
  const std::optional<AriaParameters> parameters = baseParameters(files);
  const ArcosUnits &units = robot.base().units();
  const std::string file = files.rig.devices->base.parameters.string();
  Finding finding{"base", true,
                  (parameters ? "units of " + file : "units known of a '" + subclass + "'") +
                      line(": %.3f mm, %.6f rad", 1000.0 * units.distance, units.angle)};
  if (parameters && parameters->subclass != subclass) {
    finding.good = false;
    finding.text +=
        "; the file is for a '" + parameters->subclass + "', the robot is a '" + subclass + "'";
  }
  return finding;
}

Finding hearLaser(RealRobot &robot, const LaserLink &link, double seconds)
{
  Arrivals arrivals;
  Scan last;
  listen(robot.clock(), seconds, [&] {
    last = robot.laser().scan().value_or(last);
    arrivals.note(last.stamp);
  });
  double nearest = last.rangeMax;
  int known = 0;
  for (const float range : last.ranges) {
    known += std::isnan(range) ? 0 : 1;
    nearest = std::isnan(range) ? nearest : std::min<double>(nearest, range);
  }
  Finding finding = arrivals.finding(
      "laser", link.period,
      line(", %zu readings, %d known, nearest %.2f m", last.ranges.size(), known, nearest));
  if (2 * known < static_cast<int>(last.ranges.size())) {
    finding.good = false;
    finding.text += "; most of them say nothing: is its window covered?";
  }
  return finding;
}

Finding hearCamera(RealRobot &robot, const RobotFiles &files, double seconds)
{
  Arrivals arrivals;
  double age = 0.0;
  int looks = 0;
  cv::Mat picture;
  listen(robot.clock(), seconds, [&] {
    if (const std::optional<Frame> frame = robot.camera().grab()) {
      arrivals.note(frame->stamp);
      age += toSeconds(robot.clock().now() - frame->stamp);
      ++looks;
      picture = frame->image;
    }
  });
  Finding finding =
      arrivals.finding("camera", files.rig.devices->capture.period,
                       line(", %d x %d, mean age %.2f s, %llu pictures the same as the one before",
                            picture.cols, picture.rows, age / std::max(looks, 1),
                            static_cast<unsigned long long>(robot.camera().counters().repeated)));
  const UnifiedCamera &model = files.camera.model;
  if (picture.cols != model.width() || picture.rows != model.height()) {
    finding.good = false;
    finding.text += line("; its calibration is for %d x %d", model.width(), model.height());
  }
  return finding;
}

Panorama look(RealRobot &robot, const RobotFiles &files)
{
  const Time since = robot.clock().now();
  std::optional<Frame> frame = robot.camera().grab();
  while (frame && frame->stamp < since) {
    robot.clock().sleepUntil(robot.clock().now() + std::chrono::milliseconds(20));
    frame = robot.camera().grab();
  }
  if (!frame) {
    throw DeviceError("the camera has no more pictures");
  }
  Panorama panorama = Unwarper(files.camera, PanoramaGeometry{}).unwarp(frame->image);
  if (panorama.image.channels() == 3) {
    cv::cvtColor(panorama.image, panorama.image, cv::COLOR_BGR2GRAY);
  }
  return panorama;
}

/** Drives so until `done`, at most 5 s, then stands. @throw RuntimeError when it was stopped */
void drive(RealRobot &robot, const Twist2 &twist, const std::function<bool()> &done,
           const std::atomic<bool> &stop)
{
  constexpr int kTicks = 50;
  constexpr int kStanding = 15;
  SteadyClock &clock = robot.clock();
  for (int i = 0; i < kTicks + kStanding; ++i) {
    const bool ended = stop || i >= kTicks || done();
    robot.base().drive(ended ? Twist2{} : twist);
    i = ended ? std::max(i, kTicks) : i;
    clock.sleepUntil(clock.now() + std::chrono::milliseconds(100));
  }
  if (stop) {
    throw RuntimeError("stopped; the robot stands");
  }
}

/** The middle of the ranges within 5 degrees of straight ahead, metres; NaN where it is open. */
double ahead(const Scan &scan)
{
  std::vector<float> ranges;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    if (std::abs(scan.angle(i)) < radians(5.0) && !std::isnan(scan.ranges[i])) {
      ranges.push_back(scan.ranges[i]);
    }
  }
  if (ranges.empty()) {
    return kUnknown;
  }
  std::nth_element(ranges.begin(), ranges.begin() + static_cast<std::ptrdiff_t>(ranges.size() / 2),
                   ranges.end());
  const double middle = ranges[ranges.size() / 2];
  return middle < 0.9 * scan.rangeMax ? middle : kUnknown;
}

} // namespace

std::vector<Finding> checkDevices(const RobotFiles &files, double seconds)
{
  RealRobot robot(files);
  const DeviceLinks &links = files.rig.devices.value();
  return {hearBase(robot, links.base, seconds), hearUnits(robot, files),
          hearLaser(robot, links.laser, seconds), hearCamera(robot, files, seconds)};
}

double turnBetween(const Scan &before, const Scan &after)
{
  const int most = static_cast<int>(radians(60.0) / before.angleStep);
  double best = std::numeric_limits<double>::infinity();
  int turn = 0;
  for (int shift = -most; shift <= most; ++shift) {
    const double misfit = scanMisfit(before, after, shift);
    if (misfit < best) {
      best = misfit;
      turn = shift;
    }
  }
  return turn * before.angleStep;
}

std::vector<Finding> judgeMotion(const MotionSeen &seen)
{
  std::vector<Finding> findings;
  const auto compare = [&](const char *what, double value, double truth, double unit,
                           const char *unitName, const char *reversed) {
    const double share = value / truth;
    std::string text =
        line("%s %.2f %s where odometry says %.2f", what, value / unit, unitName, truth / unit);
    if (std::isnan(share)) {
      findings.push_back({"motion", true, std::string(what) + " cannot tell here"});
      return;
    }
    const bool good = share > 0.7 && share < 1.4;
    if (!good) {
      text += share < -0.5 ? std::string("; ") + reversed : "; its scale is wrong";
    }
    findings.push_back({"motion", good, text});
  };
  findings.push_back(
      {"motion", seen.odometryTurn > kTurn / 2.0,
       line("told to turn left by 30 degrees, odometry says %.0f", degrees(seen.odometryTurn))});
  compare("turn: laser", seen.laserTurn, seen.odometryTurn, radians(1.0), "degrees",
          "the laser is upside down, or left and right wheels are exchanged");
  compare("turn: camera", seen.cameraTurn, seen.odometryTurn, radians(1.0), "degrees",
          "the camera file has left and right exchanged (mount.left_is_clockwise)");
  findings.push_back(
      {"motion", seen.odometryAdvance > kAdvance / 2.0,
       line("told to drive ahead by 0.15 m, odometry says %.2f", seen.odometryAdvance)});
  compare("advance: laser", seen.laserAdvance, seen.odometryAdvance, 1.0, "m",
          "the laser looks backwards, or the wheels turn the wrong way round");
  return findings;
}

std::vector<Finding> checkMotion(const RobotFiles &files, const std::atomic<bool> &stop)
{
  RealRobot robot(files);
  const auto pose = [&] { return robot.base().state().odometry; };
  MotionSeen seen;
  const Pose2 start = pose();
  const Scan scanBefore = robot.laser().scan().value();
  const Panorama viewBefore = look(robot, files);
  const auto turned = [&] { return wrapAngle(pose().heading - start.heading); };
  drive(
      robot, {0.0, 0.35}, [&] { return std::abs(turned()) > kTurn; }, stop);
  seen.odometryTurn = turned();
  seen.laserTurn = turnBetween(scanBefore, robot.laser().scan().value());
  const auto compass = visualCompass(look(robot, files), viewBefore);
  seen.cameraTurn = compass ? compass->headingChange : kUnknown;

  const Pose2 middle = pose();
  const double wayBefore = ahead(robot.laser().scan().value());
  const auto advanced = [&] { return (middle.inverse() * pose()).x; };
  drive(
      robot, {0.1, 0.0}, [&] { return std::abs(advanced()) > kAdvance; }, stop);
  seen.odometryAdvance = advanced();
  seen.laserAdvance = wayBefore - ahead(robot.laser().scan().value());
  return judgeMotion(seen);
}

} // namespace homeward
