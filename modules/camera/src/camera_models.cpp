// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/camera/camera_models.h>

#include <homeward/camera/double_sphere.h>
#include <homeward/camera/extended_unified.h>
#include <homeward/camera/kannala_brandt.h>
#include <homeward/camera/ocam.h>
#include <homeward/camera/unified_model.h>
#include <homeward/core/error.h>

namespace homeward
{
namespace
{

using Maker = std::unique_ptr<CameraModel> (*)(const Eigen::VectorXd &, int, int);

template <class Model>
std::unique_ptr<CameraModel> make(const Eigen::VectorXd &parameters, int width, int height)
{
  return std::make_unique<Model>(parameters, width, height);
}

struct Entry
{
  const char *name;
  Maker make;
};

constexpr Entry kModels[] = {{"unified", make<UnifiedModel>},
                             {"extended_unified", make<ExtendedUnified>},
                             {"double_sphere", make<DoubleSphere>},
                             {"kannala_brandt", make<KannalaBrandt>},
                             {"ocam", make<Ocam>}};

} // namespace

std::vector<std::string> cameraModelNames()
{
  std::vector<std::string> names;
  for (const Entry &entry : kModels) {
    names.emplace_back(entry.name);
  }
  return names;
}

std::unique_ptr<CameraModel>
makeCameraModel(const std::string &name, const Eigen::VectorXd &parameters, int width, int height)
{
  for (const Entry &entry : kModels) {
    if (name == entry.name) {
      return entry.make(parameters, width, height);
    }
  }
  throw LogicError("no camera model is called '" + name + "'");
}

} // namespace homeward
