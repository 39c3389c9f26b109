// SPDX-License-Identifier: GPL-3.0-or-later
// Tutorial 13: bring your own Gazebo world. What is broken in it is named, the rest is used.
#include "../support/laboratory.h"

#include <homeward/sim/simulator.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <cstdio>

using namespace homeward;

int main()
{
  const Laboratory pioneer = loadLaboratory(); // its robot and its camera, in another world
  const std::string world = std::string(HERE) + "/room.sdf";
  const auto room = std::make_shared<const Scene>(loadScene(world));
  std::printf("%s: %zu solids, %zu lamps\n", room->name.c_str(), room->collisions.size(),
              room->lights.size());
  for (const std::string &problem : room->problems) {
    std::printf("left out: %s\n", problem.c_str());
  }

  // Where no start is given, one is chosen: a free place near the origin.
  Simulator simulator(room, pioneer.robot, pioneer.camera);
  std::printf("the robot can get to %.0f square metres\n", simulator.freeSpace().area());

  // What it sees, beside the floor from above: black is solid, white is where the robot can get to.
  const cv::Mat seen = simulator.camera().grab()->image;
  cv::Mat plan;
  cv::cvtColor(simulator.freeSpace().floorPlan().image, plan, cv::COLOR_GRAY2BGR);
  cv::resize(plan, plan, {plan.cols * seen.rows / plan.rows, seen.rows}, 0.0, 0.0, cv::INTER_AREA);
  cv::Mat picture;
  cv::hconcat(seen, plan, picture);
  cv::imwrite("13-own-world.png", picture);
}
