// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/homing/homing_method.h>

#include <homeward/core/error.h>
#include <homeward/homing/average_landmark_vector.h>
#include <homeward/homing/bearing_homing.h>
#include <homeward/homing/combined_homing.h>
#include <homeward/homing/descent_in_image_distance.h>
#include <homeward/homing/min_warping.h>
#include <homeward/homing/scale_space_homing.h>

#include <array>
#include <string>

namespace homeward
{

namespace
{

struct NamedMethod
{
  const char *name;
  std::unique_ptr<HomingMethod> (*make)();
};

template <class Method> std::unique_ptr<HomingMethod> make()
{
  return std::make_unique<Method>();
}

constexpr std::array<NamedMethod, 6> kMethods{{{"minwarping", make<MinWarping>},
                                               {"hiss", make<ScaleSpaceHoming>},
                                               {"bearing", make<BearingHoming>},
                                               {"alv", make<AverageLandmarkVector>},
                                               {"did", make<DescentInImageDistance>},
                                               {"combined", make<CombinedHoming>}}};

} // namespace

const std::vector<std::string> &homingMethodNames()
{
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    list.reserve(kMethods.size());
    for (const NamedMethod &method : kMethods) {
      list.emplace_back(method.name);
    }
    return list;
  }();
  return names;
}

std::unique_ptr<HomingMethod> makeHomingMethod(std::string_view name)
{
  std::string known;
  for (const NamedMethod &method : kMethods) {
    if (name == method.name) {
      return method.make();
    }
    known += (known.empty() ? "" : ", ") + std::string(method.name);
  }
  throw ConfigError("homing method '" + std::string(name) + "' is unknown, use one of " + known);
}

} // namespace homeward
