// SPDX-License-Identifier: GPL-3.0-or-later
#include "mission_setup.h"

#include <homeward/homing/homing_method.h>
#include <homeward/mission/navigator.h>
#include <homeward/store/content_hash.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <unistd.h>

namespace homeward
{

OpenDirectionOptions openDirectionOptions(double forwardDistance)
{
  // In a wide room nearly everything is open; a drive is worth it wherever it can go to its end,
  // and a wide opening deserves more than one.
  OpenDirectionOptions options;
  options.stoppingRange = forwardDistance;
  options.openRangeCap = forwardDistance + 0.6;
  options.widestSegment = radians(80.0);
  options.count = 5;
  return options;
}

PilotOptions pilotOptions(const Rig &rig, bool runsByItself, const std::string &homingMethod)
{
  constexpr double kPeriods = 3.0; // a device may miss two
  PilotOptions options;
  options.motion.maxSpeed = rig.limits.maxSpeed;
  options.motion.maxTurnRate = rig.limits.maxTurnRate;
  options.homingMethod = homingMethod;
  options.homing.waitForVision = !runsByItself;
  options.directions = openDirectionOptions(NavigatorOptions{}.searchDistance);
  if (rig.devices) {
    // Nobody looks more often than once a tick, however quick the device.
    const auto silence = [tick = options.motion.tickSeconds](double period) {
      return kPeriods * std::max(period, tick);
    };
    options.motion.baseSilence = silence(rig.devices->base.period);
    options.motion.laserSilence = silence(rig.devices->laser.period);
    options.motion.cameraSilence = silence(rig.devices->capture.period);
  }
  return options;
}

void addExploreSettings(CliCommand command, ExploreSettings &settings)
{
  command.option("--forward-distance", settings.forwardDistance, "Metres driven before looking")
      .between(0.5, 20.0)
      .showDefault();
  command.option("--homing", settings.homing, "How the robot finds home by sight; hiss as the seed")
      .oneOf(homingMethodNames())
      .showDefault();
  command
      .option("--histogram-threshold", settings.histogramThreshold,
              "Recognise places by gray histograms up to this alone, as the seed (400 to 600)")
      .between(1.0, 1e6);
  command.flag("--close-known", settings.closeKnown,
               "Do not drive to where, by the ways driven, there is a node already");
  command.flag(
      "--equal-costs", settings.equalCosts,
      "Plan the way with the fewest edges, as the seed, not the one with the fewest metres");
  command.option("--max-time", settings.maxTime, "Seconds of robot time after which it stops")
      .positive()
      .showDefault();
}

nlohmann::json settingsJson(const ExploreSettings &settings)
{
  return {{"forward_distance", settings.forwardDistance},
          {"homing", settings.homing},
          {"histogram_threshold", settings.histogramThreshold},
          {"max_time", settings.maxTime},
          {"close_known", settings.closeKnown},
          {"equal_costs", settings.equalCosts}};
}

ExploreSettings exploreSettings(const nlohmann::json &json)
{
  ExploreSettings settings;
  json.at("forward_distance").get_to(settings.forwardDistance);
  json.at("homing").get_to(settings.homing);
  json.at("histogram_threshold").get_to(settings.histogramThreshold);
  json.at("max_time").get_to(settings.maxTime);
  json.at("close_known").get_to(settings.closeKnown);
  json.at("equal_costs").get_to(settings.equalCosts);
  return settings;
}

PilotOptions explorationOptions(const Rig &rig, bool runsByItself, const ExploreSettings &settings)
{
  PilotOptions options = pilotOptions(rig, runsByItself, settings.homing);
  options.directions = openDirectionOptions(settings.forwardDistance);
  if (settings.histogramThreshold > 0.0) {
    options.places.recognition = Recognition::Histogram;
    options.places.histogramThreshold = settings.histogramThreshold;
  }
  return options;
}

ExplorerOptions explorerOptions(const ExploreSettings &settings)
{
  constexpr double kCloseNear = 0.7; // metres
  ExplorerOptions options;
  options.forwardDistance = settings.forwardDistance;
  options.cost = settings.equalCosts ? RouteCost::Edges : RouteCost::ExpectedMetres;
  options.closeNear = settings.closeKnown ? kCloseNear : 0.0;
  return options;
}

MapHeader mapHeader(const RobotFiles &robot, const PilotOptions &options)
{
  MapHeader header;
  header.cameraHash = contentHashText(robot.cameraText);
  header.panorama = options.panorama;
  const bool verified = options.places.recognition == Recognition::Verified;
  header.signatureKind =
      std::string(name(verified ? SignatureKind::AlignedEdges : SignatureKind::Jeffrey));
  header.signatureVersion = kSignatureVersion;
  header.thresholds = {{"histogram_threshold", options.places.histogramThreshold},
                       {"sure_probability", kSureProbability}};
  return header;
}

void showProgress(const std::string &line)
{
  if (isatty(STDERR_FILENO) != 0) {
    std::fprintf(stderr, "\r\033[K%s", line.c_str());
    std::fflush(stderr);
  }
}

void endProgress()
{
  if (isatty(STDERR_FILENO) != 0) {
    std::fputs("\r\033[K", stderr);
  }
}

} // namespace homeward
