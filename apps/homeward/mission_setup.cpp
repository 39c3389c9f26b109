// SPDX-License-Identifier: GPL-3.0-or-later
#include "mission_setup.h"

#include <homeward/store/content_hash.h>

#include <cstdio>
#include <unistd.h>

namespace homeward
{

PilotOptions pilotOptions(const MissionRobot &robot, const std::string &homingMethod)
{
  constexpr double kPeriods = 3.0; // a device may miss two
  const Rig &rig = robot.files().rig;
  PilotOptions options;
  options.motion.maxSpeed = rig.limits.maxSpeed;
  options.motion.maxTurnRate = rig.limits.maxTurnRate;
  options.homingMethod = homingMethod;
  options.homing.waitForVision = !robot.runsByItself();
  if (rig.devices) {
    options.motion.baseSilence = kPeriods * rig.devices->base.period;
    options.motion.laserSilence = kPeriods * rig.devices->laser.period;
    options.motion.cameraSilence = kPeriods * rig.devices->capture.period;
  }
  return options;
}

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

void rememberAll(const MapFile &file, Pilot &pilot)
{
  for (const auto &[id, node] : file.map().nodes()) {
    pilot.remember(id, file.panorama(id));
  }
}

std::string name(Outcome outcome)
{
  switch (outcome) {
  case Outcome::Done:
    return "done";
  case Outcome::Stopped:
    return "stopped";
  case Outcome::Failed:
    break;
  }
  return "failed";
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
