// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/camera/camera_model_file.h>

#include "yaml_section.h"

#include <homeward/camera/camera_models.h>

namespace homeward
{
namespace
{

/** Names of the parameters of a model; an ocam's polynomial is as long as it is written. */
std::vector<std::string> namesOf(const std::string &model, const YAML::Node &parameters)
{
  if (model == "unified") {
    return {"xi", "fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "skew"};
  }
  if (model == "extended_unified") {
    return {"alpha", "beta", "fx", "fy", "cx", "cy"};
  }
  if (model == "double_sphere") {
    return {"xi", "alpha", "fx", "fy", "cx", "cy"};
  }
  if (model == "kannala_brandt") {
    return {"k1", "k2", "k3", "k4", "fx", "fy", "cx", "cy"};
  }
  std::vector<std::string> names{"a0", "a2"};
  for (const char *name : {"a3", "a4", "a5", "a6", "a7", "a8"}) {
    if (!parameters[name]) {
      break;
    }
    names.emplace_back(name);
  }
  names.insert(names.end(), {"c", "d", "e", "cx", "cy"});
  return names;
}

/** Whether a file may leave a parameter out: what bends the picture and is zero in a plain one. */
bool optional(const std::string &name)
{
  return name == "skew" || name == "d" || name == "e" || name[0] == 'k' || name[0] == 'p';
}

std::unique_ptr<CameraModel> modelOf(const YAML::Node &root, const std::string &origin)
{
  const Section top(root, "the camera file", origin,
                    {"model", "image", "parameters", "mirror", "mount", "rim"});
  const YAML::Node model = root["model"];
  const auto known = cameraModelNames();
  if (!model || !model.IsScalar() ||
      std::find(known.begin(), known.end(), model.Scalar()) == known.end()) {
    std::string names;
    for (const std::string &name : known) {
      names += (names.empty() ? "" : ", ") + name;
    }
    throw ConfigError(origin + ": model must be one of " + names +
                      (model && model.IsScalar() ? ", not '" + model.Scalar() + "'" : ""));
  }
  const Section image(root["image"], "image", origin, {"width", "height"});
  const YAML::Node given = root["parameters"];
  const auto names =
      namesOf(model.Scalar(), given && given.IsMap() ? given : YAML::Node(YAML::NodeType::Map));
  const Section section(given, "parameters", origin, names);
  Eigen::VectorXd values(static_cast<Eigen::Index>(names.size()));
  for (std::size_t i = 0; i < names.size(); ++i) {
    values[static_cast<Eigen::Index>(i)] =
        optional(names[i]) ? section.numberOr(names[i], 0.0) : section.number(names[i]);
  }
  try {
    return makeCameraModel(model.Scalar(), values, pixels(image, "width", origin),
                           pixels(image, "height", origin));
  }
  catch (const LogicError &error) {
    throw ConfigError(origin + ": " + error.what());
  }
}

} // namespace

std::unique_ptr<CameraModel> parseCameraModel(const std::string &yaml, const std::string &origin)
{
  try {
    return modelOf(YAML::Load(yaml), origin);
  }
  catch (const YAML::Exception &error) {
    throw ConfigError(origin + " is not YAML: " + error.what());
  }
}

std::string formatCameraModel(const CameraModel &model)
{
  const auto names = model.parameterNames();
  const Eigen::VectorXd values = model.parameters();
  YAML::Emitter out;
  out.SetDoublePrecision(17);
  out << YAML::BeginMap << YAML::Key << "model" << YAML::Value << model.name();
  out << YAML::Key << "image" << YAML::Value << YAML::Flow << YAML::BeginMap << YAML::Key << "width"
      << YAML::Value << model.width() << YAML::Key << "height" << YAML::Value << model.height()
      << YAML::EndMap;
  out << YAML::Key << "parameters" << YAML::Value << YAML::BeginMap;
  for (std::size_t i = 0; i < names.size(); ++i) {
    out << YAML::Key << names[i] << YAML::Value << values[static_cast<Eigen::Index>(i)];
  }
  out << YAML::EndMap << YAML::EndMap;
  return std::string(out.c_str()) + "\n";
}

} // namespace homeward
