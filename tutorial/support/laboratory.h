// SPDX-License-Identifier: GPL-3.0-or-later
// The world of the tutorials: the laboratory, 12 x 10 m, and a Pioneer with its mirror camera.
#pragma once

#include "files.h"

#include <homeward/camera/camera_file.h>
#include <homeward/robot/robot_description.h>
#include <homeward/sim/scene.h>

#include <memory>

/** What a simulation needs to know. */
struct Laboratory
{
  std::shared_ptr<const homeward::Scene> scene;
  homeward::RobotDescription robot;
  homeward::MirrorCamera camera; ///< as its maker meant it; the simulated one is a little off
};

inline Laboratory loadLaboratory()
{
  const std::string urdf = dataFile("robots/pioneer3at.urdf");
  const std::string camera = dataFile("cameras/sim_nominal.yaml");
  return {std::make_shared<const homeward::Scene>(homeward::loadScene(dataFile("worlds/lab.sdf"))),
          homeward::parseRobotDescription(readText(urdf), urdf),
          homeward::parseMirrorCamera(readText(camera), camera)};
}
