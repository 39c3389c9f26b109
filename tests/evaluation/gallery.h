// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "../contract/test_room.h"
#include "test_robot.h"

#include <homeward/core/random.h>
#include <homeward/evaluation/mission_trial.h>

#include <string>

namespace homeward
{

// Walls hung with panels of many colours, a wall across with a gap of 2.5 m.
//
//   +-------------+
//   |      |      |
//   |      |      |
//   |             |
//   +-------------+
inline Scene gallery()
{
  Random random(5, 1);
  Scene scene = makeRoom(6.0F, 4.5F);
  const auto colour = [&] {
    return Eigen::Vector3f::NullaryExpr([&] { return static_cast<float>(random.uniform(0, 1)); });
  };
  const auto panel = [&](const Eigen::Vector2f &from, const Eigen::Vector2f &to) {
    const auto low = static_cast<float>(random.uniform(0.3, 1.2));
    const auto high = static_cast<float>(random.uniform(1.4, 2.4));
    addBox(scene, {from.x(), from.y(), low}, {to.x(), to.y(), high}, colour());
  };
  for (int i = 0; i < 12; ++i) {
    const float x = 0.5F * static_cast<float>(i);
    panel({x + 0.05F, 0.0F}, {x + 0.4F, 0.02F});
    panel({x + 0.05F, 4.48F}, {x + 0.4F, 4.5F});
  }
  for (int i = 0; i < 9; ++i) {
    const float y = 0.5F * static_cast<float>(i);
    panel({0.0F, y + 0.05F}, {0.02F, y + 0.4F});
    panel({5.98F, y + 0.05F}, {6.0F, y + 0.4F});
  }
  addBox(scene, {3.0F, 2.5F, 0.0F}, {3.1F, 4.5F, 2.5F}, {0.6F, 0.4F, 0.2F});
  return scene;
}

/** The test robot, which is to explore it and then to do nothing more. */
inline MissionTrialOptions galleryOptions()
{
  MissionTrialOptions options{.robot = testRobot(), .robotFile = "", .camera = testCamera()};
  options.exploring.directions.stoppingRange = options.explorer.forwardDistance;
  options.exploring.directions.openRangeCap = options.explorer.forwardDistance + 0.6;
  options.goals = 0;
  return options;
}

inline MissionTask galleryTask(const std::string &map)
{
  return {"gallery", "", share(gallery()), 1, map};
}

} // namespace homeward
