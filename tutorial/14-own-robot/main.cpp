// SPDX-License-Identifier: GPL-3.0-or-later
// Tutorial 14: bring your own robot: a URDF, a camera file and a rig file say all that Homeward
// asks.
#include "../support/files.h"

#include <homeward/camera/unwarper.h>
#include <homeward/robot/rig.h>
#include <homeward/sim/simulator.h>

#include <opencv2/imgcodecs.hpp>

#include <cstdio>

using namespace homeward;

int main()
{
  const std::filesystem::path here = HERE;
  const std::string rigFile = here / "rig.yaml";
  const Rig rig = parseRig(readText(rigFile), rigFile);
  const std::string robotFile = here / rig.robot;
  const RobotDescription robot = parseRobotDescription(readText(robotFile), robotFile);
  const std::string cameraFile = here / rig.camera;
  const MirrorCamera camera = parseMirrorCamera(readText(cameraFile), cameraFile);

  const BodyPart body = robot.footprint();
  std::printf("%s: %.2f x %.2f m, %.2f m high, wheels %.2f m apart\n", robot.name.c_str(),
              body.xMax - body.xMin, body.yMax - body.yMin, body.zMax, robot.track);
  std::printf("laser %.2f m and mirror %.2f m above the floor\n", robot.rMl.translation().z(),
              robot.rMp.translation().z());

  // A mistake in any of these files ends in one line that says what and where.
  try {
    parseRig("robot: robot.urdf\ncamera: camera.yaml\nlimits: {max_speed: 0.3}\n", "broken.yaml");
  }
  catch (const ConfigError &error) {
    std::printf("a mistake: %s\n", error.what());
  }

  // It drives in the laboratory, within its limits, before it is built.
  const auto laboratory = std::make_shared<const Scene>(loadScene(dataFile("worlds/lab.sdf")));
  SimulatorOptions options;
  options.start = Pose2{0.0, 0.0, 0.0};
  options.limits = rig.limits;
  Simulator simulator(laboratory, robot, camera, options);
  while (toSeconds(simulator.clock().now()) < 5.0) {
    simulator.base().drive({1.0, 0.0}); // m/s: more than it may
    simulator.clock().sleepUntil(simulator.clock().now() + fromSeconds(0.1));
  }
  std::printf("asked for 1 m/s it has driven %.1f m in 5 s\n", simulator.truth().distance);

  const Unwarper unwarper(camera, PanoramaGeometry{});
  cv::imwrite("14-own-robot.png", unwarper.unwarp(simulator.camera().grab()->image).image);
}
