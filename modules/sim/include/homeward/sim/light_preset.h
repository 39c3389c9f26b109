// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/sim/scene.h>

#include <string_view>

namespace homeward
{

/** Kinds of light that a robot may meet in the same rooms. */
enum class LightPreset
{
  Day,      ///< every lamp on, bright even surroundings
  Twilight, ///< weak bluish light from above, half the lamps
  Night,    ///< a few dim warm lamps, hardly anything else
  TwoLamps  ///< two bare lamps only: strong contrast, the light comes from elsewhere
};

/** The preset called `day`, `twilight`, `night` or `two_lamps`. @throw ConfigError for any other */
LightPreset parseLightPreset(std::string_view name);

/** What parseLightPreset() reads back. */
std::string_view name(LightPreset preset);

/** All the light in a world, and how a camera's automatic exposure takes it. */
struct Lighting
{
  std::vector<Light> lights;                    ///< of the preset
  Eigen::Vector3f sky{0.4F, 0.4F, 0.4F};        ///< ambient radiance from above, linear RGB
  Eigen::Vector3f ground{0.25F, 0.25F, 0.25F};  ///< ambient radiance from below, linear RGB
  Eigen::Vector3f background{0.7F, 0.7F, 0.7F}; ///< where a ray meets nothing, linear RGB
  float exposureTarget = 0.22F;                 ///< mean of the exposed ring, linear, 1 is white
  float exposureMin = 0.05F;                    ///< smallest gain of the automatic exposure
  float exposureMax = 2.0F;                     ///< largest gain: what is darker stays darker
};

/**
 * The lights of a preset for a scene, a pure function of both.
 *
 * A world that brings few lamps gets more, hung on a grid inside its bounds and below its ceiling,
 * so that any world is well lit by day.
 */
Lighting lightingFor(LightPreset preset, const Scene &scene);

} // namespace homeward
