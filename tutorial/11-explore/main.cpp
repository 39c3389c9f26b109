// SPDX-License-Identifier: GPL-3.0-or-later
// Tutorial 11: the robot explores. The mission decides, the pilot acts, the map remembers.
#include "../support/laboratory.h"

#include <homeward/mission/explorer.h>
#include <homeward/pilot/pilot.h>
#include <homeward/sim/simulator.h>
#include <homeward/topology/planner.h>
#include <homeward/viewer/map_picture.h>

#include <opencv2/imgcodecs.hpp>

#include <atomic>
#include <cstdio>

using namespace homeward;

int main()
{
  const Laboratory laboratory = loadLaboratory();
  Simulator pioneer(laboratory.scene, laboratory.robot, laboratory.camera);

  PilotOptions options;
  options.directions.openRangeCap = 2.6;            // metres, see tutorial 09
  options.directions.widestSegment = radians(80.0); // likewise
  const std::atomic<bool> stop = false;             // a signal handler or a button would set it
  Pilot pilot({pioneer.clock(), pioneer.base(), pioneer.laser(), pioneer.camera()},
              laboratory.robot, laboratory.camera, options, stop);
  Pose2 viewedFrom; // for the picture only: where a place truly is
  pilot.onView = [&] { viewedFrom = pioneer.truth().pose; };

  // An explorer knows nothing of pictures: reports come in, commands and changes of the map go out.
  ExplorerOptions exploring;
  exploring.forwardDistance = 2.0; // metres driven before it looks again
  const Explorer explorer(exploring);
  TopologicalMap map;
  MapPicture picture;
  Step<ExplorerState> step = explorer.start(map);
  while (map.nodes().size() < 5 && !std::holds_alternative<Finish>(step.command)) {
    const Report report = pilot.execute(step.command);
    step = explorer.next(step.state, map, report);
    for (const MapChange &change : step.changes) {
      map.apply(change);
      if (const auto *added = std::get_if<NodeAdded>(&change)) {
        pilot.remember(added->node.id, pilot.view());
        picture.poses[added->node.id] = viewedFrom;
      }
    }
    picture.trajectory.push_back(pioneer.truth().pose.translation());
  }

  std::printf("places: %zu\n", map.nodes().size());
  std::printf("every place has a way to another: %s\n",
              stepDistances(map, NodeId{0}).size() == map.nodes().size() ? "yes" : "no");
  std::printf("open directions left: %s\n", map.openDirectionCount() > 0 ? "yes" : "no");
  std::printf("collisions: %d\n", pioneer.truth().collisions);

  const FloorPlan plan = pioneer.freeSpace().floorPlan();
  picture.title = "The first five places";
  picture.width = 1000;
  picture.floor = FloorPicture{plan.image, plan.origin, plan.resolution};
  picture.robot = pioneer.truth().pose;
  cv::imwrite("11-explore.png", mapImage(map, picture));
}
