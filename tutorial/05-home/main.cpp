// SPDX-License-Identifier: GPL-3.0-or-later
// Tutorial 05: two panoramas, one of home and one of here, tell which way home is.
#include "../support/views.h"

#include <homeward/homing/min_warping.h>
#include <homeward/sim/simulator.h>
#include <homeward/viewer/home_vector_picture.h>

#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <cstdio>

using namespace homeward;

/** Places on a grid round home where a robot can stand, each with another heading. */
std::vector<Pose2> placesRound(const Pose2 &home, const FreeSpace &floor)
{
  std::vector<Pose2> places;
  for (double x = -2.0; x < 2.1; x += 0.5) {
    for (double y = -2.0; y < 2.1; y += 0.5) {
      const Pose2 place{home.x + x, home.y + y, 0.7 * static_cast<double>(places.size())};
      if (floor.reachable(place.translation()) && std::hypot(x, y) > 0.1) {
        places.push_back(place);
      }
    }
  }
  return places;
}

int main()
{
  const Laboratory laboratory = loadLaboratory();
  const Simulator simulator(laboratory.scene, laboratory.robot, laboratory.camera);
  const Pose2 home{0.5, -1.0, 0.0};
  const std::vector<Pose2> places = placesRound(home, simulator.freeSpace());

  const DataSet atHome = takePictures(laboratory, {home}, LightPreset::Day);
  const DataSet here = takePictures(laboratory, places, LightPreset::Day);

  // What depends on one panorama alone is done once.
  const MinWarping method;
  const ColumnFeatures snapshot = method.prepare(atHome.panorama(0));
  HomeVectorField field{home.translation(), {}};
  std::vector<double> errors; // degrees
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto found = method.match(method.prepare(here.panorama(i)), snapshot);
    const Eigen::Vector2d way = home.translation() - places[i].translation();
    // A home vector counts from where the robot looks; it knows no other north.
    const double direction = places[i].heading + found->home.direction;
    const double error = std::abs(wrapAngle(direction - std::atan2(way.y(), way.x())));
    field.arrows.push_back({places[i].translation(), direction, error, found->home.confidence});
    errors.push_back(degrees(error));
  }

  const FloorPlan plan = simulator.freeSpace().floorPlan();
  HomeVectorPicture picture;
  picture.title = "Which way is home";
  picture.panelWidth = 640;
  picture.columns = 1;
  picture.floor = FloorPicture{plan.image, plan.origin, plan.resolution};
  picture.fields = {field};
  cv::imwrite("05-home.png", homeVectorImage(picture));

  std::sort(errors.begin(), errors.end());
  std::printf("%zu places within 2.8 m of home\n", places.size());
  std::printf("half of the arrows are right to %.0f degree\n",
              std::ceil(errors[errors.size() / 2]));
  std::printf("arrows that lead away from home: %td\n",
              std::count_if(errors.begin(), errors.end(), [](double e) { return e > 90.0; }));
}
