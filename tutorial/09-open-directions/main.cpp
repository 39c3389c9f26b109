// SPDX-License-Identifier: GPL-3.0-or-later
// Tutorial 09: from a laser scan, the directions that are worth driving.
#include "../support/laboratory.h"

#include <homeward/laser/half_scans.h>
#include <homeward/laser/open_directions.h>
#include <homeward/sim/simulator.h>
#include <homeward/viewer/scan_picture.h>

#include <opencv2/imgcodecs.hpp>

#include <cstdio>

using namespace homeward;

int main()
{
  const Laboratory laboratory = loadLaboratory();
  SimulatorOptions options;
  options.start = Pose2{0.0, 0.0, 0.0};
  Simulator pioneer(laboratory.scene, laboratory.robot, laboratory.camera, options);

  // The laser sees the half in front. The other half comes after a turn; odometry says how far it
  // was.
  const auto now = [&] { return pioneer.clock().now(); };
  std::vector<PlacedScan> halves{{*pioneer.laser().scan(), pioneer.base().state().odometry}};
  while (std::abs(pioneer.base().state().odometry.heading) < radians(175.0)) {
    pioneer.base().drive({0.0, 0.5}); // m/s, rad/s
    pioneer.clock().sleepUntil(now() + fromSeconds(0.1));
  }
  pioneer.base().drive({});
  pioneer.clock().sleepUntil(now() + fromSeconds(1.0));
  halves.push_back({*pioneer.laser().scan(), pioneer.base().state().odometry});
  const Scan scan = joinScans(halves, laboratory.robot.rMl);

  OpenDirectionOptions open;
  open.openRangeCap = 2.6;            // metres: farther than a drive of 2 m is open in any room
  open.widestSegment = radians(80.0); // what is wider becomes several
  const std::vector<OpenDirection> directions = findOpenDirections(scan, open);

  ScanPicture picture;
  picture.title = "Open directions at the start of the laboratory";
  picture.openDirections = directions;
  cv::imwrite("09-open-directions.png", scanImage(scan, picture));

  std::printf("%zu open directions\n", directions.size());
  for (const OpenDirection &direction : directions) {
    std::printf("%+4.0f degrees, %.0f wide, open for %.1f m\n", degrees(direction.bearing),
                degrees(direction.width), direction.range);
  }
}
