// SPDX-License-Identifier: GPL-3.0-or-later
// Tutorial 12: navigate. The robot is shown some places, then patrols between them by sight.
#include "../support/laboratory.h"

#include <homeward/mission/navigator.h>
#include <homeward/pilot/pilot.h>
#include <homeward/sim/simulator.h>
#include <homeward/viewer/map_picture.h>

#include <opencv2/imgcodecs.hpp>

#include <atomic>
#include <cstdio>

using namespace homeward;

/** Carries the robot from place to place, as one would push it along a route by hand. */
TopologicalMap teach(const std::vector<Pose2> &route, Simulator &pioneer, Pilot &pilot)
{
  TopologicalMap map;
  for (const Pose2 &place : route) {
    pioneer.kidnap(place);
    pilot.execute(Survey{}); // looks round
    const NodeId node = map.nextNodeId();
    map.apply(NodeAdded{{node}});
    pilot.remember(node, pilot.view());
    if (node.value > 0) {
      map.apply(EdgeAdded{{map.nextEdgeId(), NodeId{node.value - 1}, node}});
    }
  }
  return map;
}

/** Drives to a node, from wherever the robot stands; onStep is told after every command. */
template <class OnStep>
Finish navigate(const TopologicalMap &map, NodeId goal, Pilot &pilot, OnStep onStep)
{
  const Navigator navigator({});
  Step<NavigatorState> step = navigator.start(map, goal);
  while (!std::holds_alternative<Finish>(step.command)) {
    step = navigator.next(step.state, map, pilot.execute(step.command));
    onStep();
  }
  return std::get<Finish>(step.command);
}

int main()
{
  const Laboratory laboratory = loadLaboratory();
  Simulator pioneer(laboratory.scene, laboratory.robot, laboratory.camera);
  const std::atomic<bool> stop = false;
  Pilot pilot({pioneer.clock(), pioneer.base(), pioneer.laser(), pioneer.camera()},
              laboratory.robot, laboratory.camera, {}, stop);

  const std::vector<Pose2> route = {
      {0.0, 0.0, 0.0}, {1.4, -1.5, -0.5}, {3.2, -1.7, 0.0}, {4.9, -1.4, 0.3}};
  const TopologicalMap map = teach(route, pioneer, pilot);
  std::printf("shown %zu places\n", map.nodes().size());

  // Somewhere near the last place, turned: the robot has to find out where it is first.
  pioneer.kidnap(route.back() * Pose2{-0.3, 0.2, 2.0});
  MapPicture picture;
  const auto mark = [&] { picture.trajectory.push_back(pioneer.truth().pose.translation()); };
  mark();
  for (const int goal : {0, 2}) {
    const NodeId node{goal};
    const Finish finish = navigate(map, node, pilot, mark);
    const Pose2 place = route[static_cast<std::size_t>(goal)];
    const double error = (pioneer.truth().pose.translation() - place.translation()).norm();
    std::printf("to %d: %s, %s\n", goal, finish.outcome == Outcome::Done ? "done" : "failed",
                error < 0.5 ? "and it is there" : "but it is elsewhere");
  }
  std::printf("collisions: %d\n", pioneer.truth().collisions);

  for (const auto &[id, node] : map.nodes()) {
    picture.poses[id] = route[static_cast<std::size_t>(id.value)];
  }
  const FloorPlan plan = pioneer.freeSpace().floorPlan();
  picture.title = "Shown by hand, patrolled by sight";
  picture.width = 1000;
  picture.floor = FloorPicture{plan.image, plan.origin, plan.resolution};
  picture.robot = pioneer.truth().pose;
  cv::imwrite("12-navigate.png", mapImage(map, picture));
}
