// SPDX-License-Identifier: GPL-3.0-or-later
#include "format_parts.h"
#include "xml.h"

#include <algorithm>
#include <cctype>

namespace homeward
{
namespace
{

const XmlElement &cameraOf(const XmlElement &root, const std::string &origin)
{
  const XmlElement *camera = root.child("camera");
  if (camera == nullptr) {
    throw ConfigError(origin + ": there is no <camera> in <" + root.name + ">");
  }
  return *camera;
}

std::string trimmed(std::string text)
{
  const auto blank = [](unsigned char c) { return std::isspace(c) != 0; };
  text.erase(std::remove_if(text.begin(), text.end(), blank), text.end());
  return text;
}

std::string tag(const std::string &name, const std::string &value, int indent)
{
  return std::string(static_cast<std::size_t>(indent), ' ') + "<" + name + ">" + value + "</" +
         name + ">\n";
}

/** A type of ours in ViSP's style: every parameter by its name. */
constexpr const char *kOwn = "homeward_";

ModelPointer ownModel(const XmlElement &model, const std::string &name, PictureSize size,
                      const std::string &origin)
{
  std::vector<double> values;
  for (const XmlElement &element : model.children) {
    if (element.name != "type") {
      values.push_back(xmlNumber(model, element.name, origin));
    }
  }
  const auto made = modelFrom(
      name,
      Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size())),
      size, origin);
  // By name: somebody may have put them in another order.
  const auto names = made->parameterNames();
  Eigen::VectorXd ordered(static_cast<Eigen::Index>(names.size()));
  for (std::size_t i = 0; i < names.size(); ++i) {
    ordered[static_cast<Eigen::Index>(i)] = xmlNumber(model, names[i], origin);
  }
  return modelFrom(name, ordered, size, origin);
}

/** A model of vpCameraParameters; nothing for another type. */
ModelPointer vispModel(const XmlElement &model, const std::string &type, PictureSize size,
                       const std::string &origin)
{
  const auto number = [&](const char *name) { return xmlNumber(model, name, origin); };
  const bool plain = type == "perspectiveProjWithoutDistortion";
  if (plain || type == "perspectiveProjWithDistortion") {
    Eigen::VectorXd p = Eigen::VectorXd::Zero(10);
    p.head<6>() << 0.0, number("px"), number("py"), number("u0"), number("v0"),
        plain ? 0.0 : number("kud");
    return modelFrom("unified", p, size, origin);
  }
  if (type == "ProjWithKannalaBrandtDistortion") {
    // ViSP has one term more: k5 t^11.
    if (number("k5") != 0.0) {
      throw ConfigError(origin + ": k5 is " + digits(number("k5")) +
                        ", and this program's Kannala-Brandt model ends with k4; calibrate "
                        "with k5 held at 0");
    }
    Eigen::VectorXd p(8);
    p << number("k1"), number("k2"), number("k3"), number("k4"), number("px"), number("py"),
        number("u0"), number("v0");
    return modelFrom("kannala_brandt", p, size, origin);
  }
  return nullptr;
}

} // namespace

ModelPointer parseVisp(const std::string &text, const std::string &origin,
                       std::optional<PictureSize> given)
{
  const XmlElement root = parseXml(text, origin);
  const XmlElement &camera = cameraOf(root, origin);
  const bool sized = camera.child("image_width") != nullptr;
  const PictureSize size =
      sizeOr(sized ? xmlNumber(camera, "image_width", origin) : 0.0,
             sized ? xmlNumber(camera, "image_height", origin) : 0.0, given, origin);
  ModelPointer best;
  std::string types;
  for (const XmlElement &model : camera.children) {
    if (model.name != "model" || model.child("type") == nullptr) {
      continue;
    }
    const std::string type = trimmed(model.child("type")->text);
    types.append(1, ' ').append(type);
    // The last one a camera has is the one that says most.
    const std::string own(kOwn);
    ModelPointer found = type.compare(0, own.size(), own) == 0
                             ? ownModel(model, type.substr(own.size()), size, origin)
                             : vispModel(model, type, size, origin);
    best = found ? std::move(found) : std::move(best);
  }
  if (!best) {
    throw ConfigError(origin + ": no <model> of a type that is known here" +
                      (types.empty() ? "" : ", only" + types));
  }
  return best;
}

std::string formatVisp(const CameraModel &model)
{
  const Eigen::VectorXd p = model.parameters();
  std::string out = "<?xml version=\"1.0\"?>\n<root>\n  <camera>\n" + tag("name", "Camera", 4) +
                    tag("image_width", std::to_string(model.width()), 4) +
                    tag("image_height", std::to_string(model.height()), 4) + "    <model>\n";
  const bool pinhole = model.name() == "unified" && p[0] == 0.0 && p.tail<4>().isZero(0.0);
  const auto affine = [&](Eigen::Index at) {
    return tag("px", digits(p[at]), 6) + tag("py", digits(p[at + 1]), 6) +
           tag("u0", digits(p[at + 2]), 6) + tag("v0", digits(p[at + 3]), 6);
  };
  if (pinhole && p[5] == 0.0) {
    out += tag("type", "perspectiveProjWithoutDistortion", 6) + affine(1);
  }
  else if (pinhole) {
    out += tag("type", "perspectiveProjWithDistortion", 6) + affine(1) +
           tag("kud", digits(p[5]), 6) + tag("kdu", digits(-p[5]), 6);
  }
  else if (model.name() == "kannala_brandt") {
    out += tag("type", "ProjWithKannalaBrandtDistortion", 6) + affine(4) +
           tag("k1", digits(p[0]), 6) + tag("k2", digits(p[1]), 6) + tag("k3", digits(p[2]), 6) +
           tag("k4", digits(p[3]), 6) + tag("k5", "0", 6);
  }
  else {
    out += tag("type", kOwn + model.name(), 6);
    const auto names = model.parameterNames();
    for (std::size_t i = 0; i < names.size(); ++i) {
      out += tag(names[i], digits(p[static_cast<Eigen::Index>(i)]), 6);
    }
  }
  return out + "    </model>\n  </camera>\n</root>\n";
}

ModelPointer parseLibper(const std::string &text, const std::string &origin,
                         std::optional<PictureSize> given)
{
  const XmlElement root = parseXml(text, origin);
  const XmlElement &camera = cameraOf(root, origin);
  constexpr double kOmni = 0.0; // CameraModelType
  constexpr double kPerspective = 1.0;
  const double type = xmlNumber(camera, "type", origin);
  if (type != kOmni && type != kPerspective) {
    throw ConfigError(origin + ": <type> " + digits(type) +
                      " is neither 0 (omni) nor 1 (perspective), which are read here");
  }
  Eigen::VectorXd p = Eigen::VectorXd::Zero(10);
  p.head<5>() << (type == kOmni ? xmlNumber(camera, "xi", origin) : 0.0),
      xmlNumber(camera, "au", origin), xmlNumber(camera, "av", origin),
      xmlNumber(camera, "u0", origin), xmlNumber(camera, "v0", origin);
  return modelFrom("unified", p, sizeOr(0.0, 0.0, given, origin), origin);
}

std::string formatLibper(const CameraModel &model)
{
  const Eigen::VectorXd p = model.parameters();
  if (model.name() != "unified") {
    cannotHold("libPeR", model, "anything");
  }
  if (!p.tail<5>().isZero(0.0)) {
    cannotHold("libPeR", model, "distortion or skew");
  }
  return "<?xml version=\"1.0\"?>\n<root>\n  <camera>\n" + tag("name", "Camera", 4) +
         tag("type", "0", 4) + tag("au", digits(p[1]), 4) + tag("av", digits(p[2]), 4) +
         tag("u0", digits(p[3]), 4) + tag("v0", digits(p[4]), 4) + tag("xi", digits(p[0]), 4) +
         "  </camera>\n</root>\n";
}

} // namespace homeward
