// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/calib/board_view.h>
#include <homeward/camera/camera_model.h>
#include <homeward/core/angle.h>
#include <homeward/core/random.h>

#include <Eigen/Geometry>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace homeward
{

/** Views of `view,image,corner,X_m,Y_m,Z_m,u_px,v_px`, one line a corner. */
inline BoardViews readCorners(const std::filesystem::path &file, int width, int height)
{
  BoardViews views{width, height, {}};
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::vector<std::string> cells;
    std::stringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) {
      cells.push_back(cell);
    }
    if (views.views.empty() || views.views.back().name != cells.at(1)) {
      views.views.push_back({cells.at(1), {}, {}, {}});
    }
    BoardView &view = views.views.back();
    view.ids.push_back(std::stoi(cells.at(2)));
    view.board.emplace_back(std::stod(cells.at(3)), std::stod(cells.at(4)), std::stod(cells.at(5)));
    view.pixels.emplace_back(std::stod(cells.at(6)), std::stod(cells.at(7)));
  }
  return views;
}

/** How synthetic views are taken. */
struct ViewPlan
{
  int views = 15;
  int columns = 9; ///< of the board's corners
  int rows = 6;
  double pitch = 0.05;   ///< metres
  double noise = 0.1;    ///< standard deviation of a coordinate, pixels
  double outliers = 0.0; ///< share of points that are up to 30 pixels off
  double lowest = -25.0; ///< elevation of the board's middle, degrees
  double highest = 25.0;
  double nearest = 0.25; ///< metres
  double farthest = 0.6;
  bool leftHanded = false; ///< the camera is a mirror: frame c is left-handed
  double bend = 0.0;       ///< metres the board's middle stands out: a solid target
};

/**
 * Views of a board held round the mirror, its printed face (x right, y down) to the mirror. Points
 * out of the picture or nearer than 30 pixels to the centre are not seen.
 */
inline BoardViews takeViews(const CameraModel &camera, const ViewPlan &plan, std::uint64_t seed)
{
  BoardViews taken{camera.width(), camera.height(), {}};
  Random random(seed, 0);
  const Eigen::Vector2d centre = *camera.project(Eigen::Vector3d::UnitZ());
  for (int v = 0; static_cast<int>(taken.views.size()) < plan.views && v < 1000; ++v) {
    const double azimuth = 2.0 * kPi * v / plan.views + random.uniform(-0.3, 0.3);
    const double elevation = radians(random.uniform(plan.lowest, plan.highest));
    const double distance = random.uniform(plan.nearest, plan.farthest);
    // In a right-handed frame s with z up; the board's z points away from the eye.
    const Eigen::Vector3d away(std::cos(elevation) * std::cos(azimuth),
                               std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
    const Eigen::Vector3d right = away.cross(Eigen::Vector3d::UnitZ()).normalized();
    Eigen::Matrix3d R;
    R << right, away.cross(right), away;
    const Eigen::Vector3d axis(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    R = R * Eigen::AngleAxisd(random.uniform(-0.6, 0.6), axis.normalized()).toRotationMatrix();
    const Eigen::Vector3d half(0.5 * (plan.columns - 1) * plan.pitch,
                               0.5 * (plan.rows - 1) * plan.pitch, 0.0);
    BoardView view;
    view.name = "synthetic " + std::to_string(taken.views.size());
    for (int i = 0; i < plan.columns * plan.rows; ++i) {
      const int row = i / plan.columns;
      const int column = i % plan.columns;
      const Eigen::Vector3d point(column * plan.pitch, row * plan.pitch, plan.bend * (row % 2));
      const Eigen::Vector3d inScene = distance * away + R * (point - half);
      // Frame c: z down. A lens looking down has y turned too; a mirror's picture has not.
      const Eigen::Vector3d cX(inScene.x(), plan.leftHanded ? inScene.y() : -inScene.y(),
                               -inScene.z());
      const auto pixel = camera.project(cX);
      if (!pixel) {
        continue;
      }
      Eigen::Vector2d seen =
          *pixel + plan.noise * Eigen::Vector2d(random.normal(1.0), random.normal(1.0));
      if (random.uniform(0.0, 1.0) < plan.outliers) {
        seen += Eigen::Vector2d(random.uniform(-30, 30), random.uniform(-30, 30));
      }
      if (seen.x() >= 0 && seen.y() >= 0 && seen.x() < camera.width() &&
          seen.y() < camera.height() && (seen - centre).norm() > 30.0) {
        view.ids.push_back(i);
        view.board.push_back(point);
        view.pixels.push_back(seen);
      }
    }
    if (view.ids.size() >= 12) {
      taken.views.push_back(view);
    }
  }
  return taken;
}

} // namespace homeward
