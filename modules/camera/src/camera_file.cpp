// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/camera/camera_file.h>

#include "yaml_section.h"

#include <homeward/core/angle.h>
#include <homeward/core/error.h>

#include <yaml-cpp/yaml.h>

#include <string>
#include <utility>

namespace homeward
{
namespace
{

UnifiedCamera::Parameters parametersOf(const YAML::Node &root, const std::string &origin)
{
  const Section section(root["parameters"], "parameters", origin,
                        {"xi", "fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "skew"});
  UnifiedCamera::Parameters p;
  p.xi = section.number("xi");
  p.fx = section.number("fx");
  p.fy = section.number("fy");
  p.cx = section.number("cx");
  p.cy = section.number("cy");
  p.k1 = section.numberOr("k1", 0.0);
  p.k2 = section.numberOr("k2", 0.0);
  p.p1 = section.numberOr("p1", 0.0);
  p.p2 = section.numberOr("p2", 0.0);
  p.skew = section.numberOr("skew", 0.0);
  return p;
}

std::optional<MirrorRim> rimOf(const YAML::Node &root, const std::string &origin)
{
  if (!root["rim"]) {
    return std::nullopt;
  }
  const Section rim(root["rim"], "rim", origin, {"u", "v", "radius_px"});
  const MirrorRim result{{rim.number("u"), rim.number("v")}, rim.number("radius_px")};
  if (!(result.radius > 0.0)) {
    throw ConfigError(origin + ": rim.radius_px " + std::to_string(result.radius) +
                      " must be above 0");
  }
  return result;
}

MirrorCamera cameraOf(const YAML::Node &root, const std::string &origin)
{
  const Section top(root, "the camera file", origin,
                    {"model", "image", "parameters", "mirror", "mount", "rim"});
  const YAML::Node model = root["model"];
  if (!model || !model.IsScalar() || model.Scalar() != "unified") {
    throw ConfigError(origin + ": model of a mirror on a robot must be 'unified'" +
                      (model && model.IsScalar() ? ", not '" + model.Scalar() + "'" : ""));
  }
  const Section image(root["image"], "image", origin, {"width", "height"});
  if (!root["mirror"]) {
    throw ConfigError(origin + ": mirror is missing, the file tells the camera only; "
                               "homeward-calibrate convert --picture PICTURE adds its rim");
  }
  const Section mirror(root["mirror"], "mirror", origin, {"inner_radius_px", "outer_radius_px"});
  const Section mount(root["mount"], "mount", origin, {"forward_deg", "left_is_clockwise"});
  const MirrorRing ring{mirror.number("inner_radius_px"), mirror.number("outer_radius_px")};
  if (ring.inner < 0.0 || ring.outer <= ring.inner) {
    throw ConfigError(origin + ": mirror.inner_radius_px " + std::to_string(ring.inner) +
                      " must be 0 or more and smaller than outer_radius_px " +
                      std::to_string(ring.outer));
  }
  try {
    return {UnifiedCamera(parametersOf(root, origin), pixels(image, "width", origin),
                          pixels(image, "height", origin)),
            ring,
            {radians(mount.number("forward_deg")), mount.flag("left_is_clockwise")},
            rimOf(root, origin)};
  }
  catch (const LogicError &error) {
    throw ConfigError(origin + ": " + error.what());
  }
}

} // namespace

MirrorCamera parseMirrorCamera(const std::string &yaml, const std::string &origin)
{
  try {
    return cameraOf(YAML::Load(yaml), origin);
  }
  catch (const YAML::Exception &error) {
    throw ConfigError(origin + " is not YAML: " + error.what());
  }
}

std::string formatMirrorCamera(const MirrorCamera &camera)
{
  const UnifiedCamera::Parameters &p = camera.model.parameters();
  YAML::Emitter out;
  out.SetDoublePrecision(17);
  out << YAML::BeginMap << YAML::Key << "model" << YAML::Value << "unified";
  out << YAML::Key << "image" << YAML::Value << YAML::Flow << YAML::BeginMap << YAML::Key << "width"
      << YAML::Value << camera.model.width() << YAML::Key << "height" << YAML::Value
      << camera.model.height() << YAML::EndMap;
  out << YAML::Key << "parameters" << YAML::Value << YAML::BeginMap;
  const std::pair<const char *, double> values[] = {
      {"xi", p.xi}, {"fx", p.fx}, {"fy", p.fy}, {"cx", p.cx}, {"cy", p.cy},
      {"k1", p.k1}, {"k2", p.k2}, {"p1", p.p1}, {"p2", p.p2}, {"skew", p.skew}};
  for (const auto &[key, value] : values) {
    out << YAML::Key << key << YAML::Value << value;
  }
  out << YAML::EndMap << YAML::Key << "mirror" << YAML::Value << YAML::BeginMap << YAML::Key
      << "inner_radius_px" << YAML::Value << camera.ring.inner << YAML::Key << "outer_radius_px"
      << YAML::Value << camera.ring.outer << YAML::EndMap;
  out << YAML::Key << "mount" << YAML::Value << YAML::BeginMap << YAML::Key << "forward_deg"
      << YAML::Value << degrees(camera.mount.forward) << YAML::Key << "left_is_clockwise"
      << YAML::Value << camera.mount.leftIsClockwise << YAML::EndMap;
  if (camera.rim) {
    out << YAML::Key << "rim" << YAML::Value << YAML::Flow << YAML::BeginMap << YAML::Key << "u"
        << YAML::Value << camera.rim->centre.x() << YAML::Key << "v" << YAML::Value
        << camera.rim->centre.y() << YAML::Key << "radius_px" << YAML::Value << camera.rim->radius
        << YAML::EndMap;
  }
  out << YAML::EndMap;
  return std::string(out.c_str()) + "\n";
}

} // namespace homeward
