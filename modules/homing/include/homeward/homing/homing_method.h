// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/panorama.h>
#include <homeward/homing/home_vector.h>

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace homeward
{

/** A way home from two panoramas and nothing else: no map, no odometry. */
class HomingMethod
{
public:
  virtual ~HomingMethod() = default;

  /**
   * Home vector from the current view to the place of the snapshot.
   * @param current, snapshot gray or BGR panoramas that show the horizon; sizes may differ
   * @return nothing where the pictures carry no answer (black, uniform); never NaN
   * @throw LogicError for an empty picture, a wrong type or a size unlike its geometry
   */
  virtual std::optional<HomeVector> compute(const Panorama &current, const Panorama &snapshot) = 0;
};

/**
 * What makeHomingMethod() knows: minwarping (MinWarping), hiss (ScaleSpaceHoming), bearing
 * (BearingHoming), alv (AverageLandmarkVector), did (DescentInImageDistance), combined
 * (CombinedHoming).
 */
const std::vector<std::string> &homingMethodNames();

/**
 * A method with its default options.
 * @param name one of homingMethodNames()
 * @throw ConfigError naming the known methods
 */
std::unique_ptr<HomingMethod> makeHomingMethod(std::string_view name);

} // namespace homeward
