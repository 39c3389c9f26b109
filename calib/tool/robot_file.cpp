// SPDX-License-Identifier: GPL-3.0-or-later
#include "robot_file.h"

#include <homeward/core/error.h>

#include <tinyxml2.h>

#include <array>
#include <cstdio>
#include <sstream>

namespace homeward
{
namespace
{

using Triple = std::array<double, 3>;

/** Three numbers of an attribute; zeros where it is missing. */
Triple tripleOf(const tinyxml2::XMLElement &element, const char *name, const std::string &origin)
{
  Triple values{};
  const char *text = element.Attribute(name);
  if (text == nullptr) {
    return values;
  }
  std::istringstream stream(text);
  if (!(stream >> values[0] >> values[1] >> values[2])) {
    throw ConfigError(origin + ": " + name + "=\"" + text + "\" must be three numbers");
  }
  return values;
}

std::string textOf(const Triple &values)
{
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), "%.4f %.4f %.4f", values[0], values[1], values[2]);
  return text.data();
}

tinyxml2::XMLElement &mirrorJoint(tinyxml2::XMLElement &robot, const std::string &origin)
{
  for (auto *joint = robot.FirstChildElement("joint"); joint != nullptr;
       joint = joint->NextSiblingElement("joint")) {
    const auto *child = joint->FirstChildElement("child");
    if (child == nullptr || !child->Attribute("link", "mirror")) {
      continue;
    }
    const auto *parent = joint->FirstChildElement("parent");
    if (parent == nullptr || !parent->Attribute("link", "base_link")) {
      throw ConfigError(origin + ": the joint to the link mirror must have the parent base_link");
    }
    return *joint;
  }
  throw ConfigError(origin + ": no joint leads to a link mirror; add one, its origin is the "
                             "mirror's focus");
}

} // namespace

std::string withMirrorAt(const std::string &xml, const std::string &origin, const Pose2 &rMp)
{
  tinyxml2::XMLDocument document;
  document.Parse(xml.c_str(), xml.size());
  tinyxml2::XMLElement *robot = document.FirstChildElement("robot");
  if (document.Error() || robot == nullptr) {
    throw ConfigError(origin + " is no URDF document");
  }
  tinyxml2::XMLElement &joint = mirrorJoint(*robot, origin);
  tinyxml2::XMLElement *place = joint.FirstChildElement("origin");
  if (place == nullptr) {
    place = joint.InsertNewChildElement("origin");
  }
  Triple xyz = tripleOf(*place, "xyz", origin);
  Triple rpy = tripleOf(*place, "rpy", origin);
  xyz[0] = rMp.x;
  xyz[1] = rMp.y;
  rpy[2] = rMp.heading;
  place->SetAttribute("xyz", textOf(xyz).c_str());
  place->SetAttribute("rpy", textOf(rpy).c_str());
  tinyxml2::XMLPrinter printer;
  document.Print(&printer);
  return printer.CStr();
}

} // namespace homeward
