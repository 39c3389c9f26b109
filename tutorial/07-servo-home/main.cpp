// SPDX-License-Identifier: GPL-3.0-or-later
// Tutorial 07: the first servo task. The robot leaves home blindly and comes back by sight.
//
// First task, to the place:  s = (rho, beta), distance and bearing of home,
//                            s* = (3/4 rho, 0): nearer, straight ahead; freedoms (v, w).
// Second task, the heading:  s = (psi), heading against home's, s* = (0); freedom (w).
#include "../support/laboratory.h"

#include <homeward/camera/rim.h>
#include <homeward/camera/unwarper.h>
#include <homeward/homing/min_warping.h>
#include <homeward/servo/homing_servo.h>
#include <homeward/sim/simulator.h>
#include <homeward/viewer/map_picture.h>

#include <opencv2/imgcodecs.hpp>

#include <cstdio>

using namespace homeward;

/** Drives for so many seconds and remembers where that led. */
void drive(Simulator &pioneer, const Twist2 &twist, double seconds,
           std::vector<Eigen::Vector2d> &path)
{
  for (double spent = 0.0; spent < seconds; spent += 0.2) {
    pioneer.base().drive(twist); // a base stops by itself when it hears nothing for 0.6 s
    pioneer.clock().sleepUntil(pioneer.clock().now() + fromSeconds(0.2));
    path.push_back(pioneer.truth().pose.translation());
  }
}

int main()
{
  const Laboratory laboratory = loadLaboratory();
  SimulatorOptions options;
  options.start = Pose2{0.0, 0.0, 0.0};
  Simulator pioneer(laboratory.scene, laboratory.robot, laboratory.camera, options);
  const std::optional<Eigen::Vector2d> shift =
      rimShift(pioneer.camera().grab()->image, laboratory.camera);
  const Unwarper unwarper(shift ? followRim(laboratory.camera, {*shift}) : laboratory.camera,
                          PanoramaGeometry{});
  const auto look = [&] { return unwarper.unwarp(pioneer.camera().grab()->image); };
  const Pose2 home = pioneer.truth().pose;
  const auto metresAway = [&] {
    return (pioneer.truth().pose.translation() - home.translation()).norm();
  };

  const Panorama snapshot = look(); // all that is kept of home
  std::vector<Eigen::Vector2d> path;
  drive(pioneer, {0.4, -0.15}, 9.0, path);
  std::printf("left home: %.1f m away\n", metresAway());

  MinWarping method;
  HomingServo servo(laboratory.robot.rMp);
  std::optional<HomeVector> toHome = method.compute(look(), snapshot);
  for (int step = 0; step < 100 && toHome && toHome->distanceProxy > 0.05; ++step) {
    drive(pioneer, servo.approach(*toHome), 0.4, path);
    toHome = method.compute(look(), snapshot);
  }
  for (int step = 0; step < 50 && toHome && std::abs(toHome->headingChange) > radians(1.0);
       ++step) {
    drive(pioneer, servo.align(toHome->headingChange), 0.4, path);
    toHome = method.compute(look(), snapshot);
  }

  const double turned = std::abs(degrees(wrapAngle(pioneer.truth().pose.heading - home.heading)));
  std::printf("home again to 0.3 m: %s\n", metresAway() < 0.3 ? "yes" : "no");
  std::printf("heading again to 5 degrees: %s\n", turned < 5.0 ? "yes" : "no");
  std::printf("collisions: %d\n", pioneer.truth().collisions);

  TopologicalMap map;
  map.apply(NodeAdded{{map.nextNodeId()}}); // home, to be drawn
  const FloorPlan plan = pioneer.freeSpace().floorPlan();
  MapPicture picture;
  picture.title = "Out blindly, home by sight";
  picture.width = 1000;
  picture.poses = {{NodeId{0}, home}};
  picture.floor = FloorPicture{plan.image, plan.origin, plan.resolution};
  picture.trajectory = path;
  picture.robot = pioneer.truth().pose;
  cv::imwrite("07-servo-home.png", mapImage(map, picture));
}
