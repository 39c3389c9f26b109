// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/homing/homing_method.h>

#include <homeward/core/error.h>
#include <homeward/homing/min_warping.h>
#include <homeward/homing/scale_space_homing.h>

#include <string>

namespace homeward
{

std::unique_ptr<HomingMethod> makeHomingMethod(std::string_view name)
{
  if (name == "minwarping") {
    return std::make_unique<MinWarping>();
  }
  if (name == "hiss") {
    return std::make_unique<ScaleSpaceHoming>();
  }
  throw ConfigError("homing method '" + std::string(name) + "' is unknown, use minwarping or hiss");
}

} // namespace homeward
