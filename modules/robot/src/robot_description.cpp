// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/error.h>
#include <homeward/robot/robot_description.h>

#include "urdf_document.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

namespace homeward
{
namespace
{

/** Wheels nearer to the middle than this are casters: they carry, they do not steer. Metres. */
constexpr double kCasterOffset = 0.01;

struct Shape
{
  std::string link;
  urdf::GeometrySharedPtr geometry;
  Eigen::Isometry3d wMshape;
};

struct Wheel
{
  std::string link;
  Eigen::Vector3d centre; ///< in the root link's frame
  double radius = 0.0;
};

Eigen::Isometry3d toIsometry(const urdf::Pose &pose)
{
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.translation() = Eigen::Vector3d(pose.position.x, pose.position.y, pose.position.z);
  const urdf::Rotation &q = pose.rotation;
  result.linear() = Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized().toRotationMatrix();
  return result;
}

bool isWheel(const urdf::Joint &joint)
{
  return joint.type == urdf::Joint::CONTINUOUS && joint.name.find("wheel") != std::string::npos;
}

/** Half the size of the upright box around a shape, metres. */
Eigen::Vector3d halfExtent(const urdf::Geometry &geometry, const Eigen::Matrix3d &rotation,
                           const std::string &where)
{
  if (const auto *box = dynamic_cast<const urdf::Box *>(&geometry)) {
    return rotation.cwiseAbs() * Eigen::Vector3d(box->dim.x, box->dim.y, box->dim.z) / 2.0;
  }
  if (const auto *sphere = dynamic_cast<const urdf::Sphere *>(&geometry)) {
    return Eigen::Vector3d::Constant(sphere->radius);
  }
  if (const auto *cylinder = dynamic_cast<const urdf::Cylinder *>(&geometry)) {
    const Eigen::Array3d axis = rotation.col(2).array();
    const Eigen::Array3d across = (1.0 - axis.square()).cwiseMax(0.0).sqrt();
    return (axis.abs() * (cylinder->length / 2.0) + across * cylinder->radius).matrix();
  }
  throw ConfigError(where +
                    ": a <collision> mesh is not supported; use boxes, cylinders or spheres");
}

/** Walks the tree of links and gathers what a RobotDescription is made of. */
class Walk
{
public:
  Walk(const urdf::ModelInterface &model, std::string origin)
      : m_origin(std::move(origin)), m_name(model.getName())
  {
    visit(*model.getRoot(), Eigen::Isometry3d::Identity());
  }

  RobotDescription description() const;

private:
  void visit(const urdf::Link &link, const Eigen::Isometry3d &wMlink);
  void addCollisions(const urdf::Link &link, const Eigen::Isometry3d &wMlink);
  void addWheel(const urdf::Link &link, const Eigen::Isometry3d &wMlink);
  Eigen::Isometry3d rootToRobot() const;
  const Eigen::Isometry3d &frame(const std::string &link, const std::string &why) const;
  void placeSonars(const Eigen::Isometry3d &rMw, RobotDescription &description) const;
  void measureWheels(RobotDescription &description) const;
  [[noreturn]] void refuse(const std::string &what) const
  {
    throw ConfigError(m_origin + ": " + what);
  }

  std::string m_origin;
  std::string m_name;
  std::map<std::string, Eigen::Isometry3d> m_frames; ///< wMlink, w being the root link
  std::vector<Shape> m_shapes;
  std::vector<Wheel> m_wheels;
};

void Walk::visit(const urdf::Link &link, const Eigen::Isometry3d &wMlink)
{
  m_frames[link.name] = wMlink;
  addCollisions(link, wMlink);
  for (const urdf::JointSharedPtr &joint : link.child_joints) {
    const bool wheel = isWheel(*joint);
    if (joint->type != urdf::Joint::FIXED && !wheel) {
      refuse("joint '" + joint->name + "' moves; only fixed joints and continuous joints named " +
             "*wheel* are supported");
    }
    const auto child = std::find_if(
        link.child_links.begin(), link.child_links.end(),
        [&](const urdf::LinkSharedPtr &each) { return each->name == joint->child_link_name; });
    if (child == link.child_links.end()) {
      refuse("joint '" + joint->name + "' leads to no link");
    }
    const Eigen::Isometry3d wMchild = wMlink * toIsometry(joint->parent_to_joint_origin_transform);
    visit(**child, wMchild);
    if (wheel) {
      addWheel(**child, wMchild);
    }
  }
}

void Walk::addCollisions(const urdf::Link &link, const Eigen::Isometry3d &wMlink)
{
  for (const urdf::CollisionSharedPtr &collision : link.collision_array) {
    if (!collision || !collision->geometry) {
      continue;
    }
    m_shapes.push_back({link.name, collision->geometry, wMlink * toIsometry(collision->origin)});
  }
}

void Walk::addWheel(const urdf::Link &link, const Eigen::Isometry3d &wMlink)
{
  const urdf::Geometry *geometry = link.collision ? link.collision->geometry.get() : nullptr;
  Wheel wheel{link.name, wMlink.translation(), 0.0};
  if (const auto *cylinder = dynamic_cast<const urdf::Cylinder *>(geometry)) {
    wheel.radius = cylinder->radius;
  }
  else if (const auto *sphere = dynamic_cast<const urdf::Sphere *>(geometry)) {
    wheel.radius = sphere->radius;
  }
  else {
    refuse("wheel link '" + link.name + "' has no cylinder or sphere as <collision>");
  }
  m_wheels.push_back(wheel);
}

const Eigen::Isometry3d &Walk::frame(const std::string &link, const std::string &why) const
{
  const auto found = m_frames.find(link);
  if (found == m_frames.end()) {
    refuse("no link named '" + link + "' (" + why + ")");
  }
  return found->second;
}

/** rMw: r is on the floor under the middle of the driven wheels, its axes are base_link's. */
Eigen::Isometry3d Walk::rootToRobot() const
{
  const Eigen::Isometry3d &wMbase = frame("base_link", "the body that the frames refer to");
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  double count = 0.0;
  double floor = std::numeric_limits<double>::infinity();
  for (const Wheel &wheel : m_wheels) {
    const Eigen::Vector3d centre = wMbase.inverse() * wheel.centre;
    floor = std::min(floor, centre.z() - wheel.radius);
    if (std::abs(centre.y()) > kCasterOffset) {
      middle += centre;
      count += 1.0;
    }
  }
  if (count == 0.0) {
    refuse("no driven wheels: no continuous joints named *wheel* on the left and on the right");
  }
  middle /= count;
  const Eigen::Isometry3d wMr = wMbase * Eigen::Translation3d(middle.x(), middle.y(), floor);
  return wMr.inverse();
}

void Walk::measureWheels(RobotDescription &description) const
{
  const Eigen::Isometry3d baseMw = frame("base_link", "the body").inverse();
  double left = 0.0;
  double right = 0.0;
  std::size_t leftCount = 0;
  std::size_t rightCount = 0;
  for (const Wheel &wheel : m_wheels) {
    const double y = (baseMw * wheel.centre).y();
    if (std::abs(y) <= kCasterOffset) {
      continue;
    }
    if (description.wheelRadius != 0.0 && wheel.radius != description.wheelRadius) {
      refuse("wheel link '" + wheel.link + "' has another radius than the first wheel");
    }
    description.wheelRadius = wheel.radius;
    (y > 0.0 ? left : right) += y;
    ++(y > 0.0 ? leftCount : rightCount);
  }
  if (leftCount == 0 || rightCount == 0) {
    refuse(std::string("no driven wheel on the ") + (leftCount == 0 ? "left" : "right"));
  }
  description.track =
      left / static_cast<double>(leftCount) - right / static_cast<double>(rightCount);
}

/** The number n of a link named sonar_<n>; nothing for other names. */
std::optional<int> sonarNumber(const std::string &link)
{
  static const std::string kPrefix = "sonar_";
  if (!link.starts_with(kPrefix)) {
    return std::nullopt;
  }
  int number = 0;
  const char *end = link.data() + link.size();
  const auto parsed = std::from_chars(link.data() + kPrefix.size(), end, number);
  return parsed.ec == std::errc() && parsed.ptr == end ? std::optional(number) : std::nullopt;
}

void Walk::placeSonars(const Eigen::Isometry3d &rMw, RobotDescription &description) const
{
  std::map<int, SonarMount> byNumber;
  for (const auto &[link, wMsonar] : m_frames) {
    if (const std::optional<int> number = sonarNumber(link)) {
      const Eigen::Isometry3d rMsonar = rMw * wMsonar;
      const Eigen::Vector3d at = rMsonar.translation();
      const Eigen::Vector3d axis = rMsonar.linear().col(0);
      byNumber[*number] = {at.x(), at.y(), at.z(), std::atan2(axis.y(), axis.x())};
    }
  }
  for (const auto &[number, sonar] : byNumber) {
    description.sonars.push_back(sonar);
  }
}

RobotDescription Walk::description() const
{
  if (m_shapes.empty()) {
    refuse("no <collision> on any link; the body needs boxes, cylinders or spheres");
  }
  RobotDescription description;
  description.name = m_name;
  const Eigen::Isometry3d rMw = rootToRobot();
  measureWheels(description);
  for (const Shape &shape : m_shapes) {
    const Eigen::Isometry3d rMshape = rMw * shape.wMshape;
    const Eigen::Vector3d half =
        halfExtent(*shape.geometry, rMshape.linear(), m_origin + ": link '" + shape.link + "'");
    const Eigen::Vector3d low = rMshape.translation() - half;
    const Eigen::Vector3d high = rMshape.translation() + half;
    description.body.push_back(
        {shape.link, low.x(), high.x(), low.y(), high.y(), low.z(), high.z()});
  }
  description.rMl = rMw * frame("laser", "the laser scanner's frame");
  description.rMp = rMw * frame("mirror", "the frame in the mirror's focus");
  placeSonars(rMw, description);
  return description;
}

} // namespace

BodyPart RobotDescription::footprint() const
{
  if (body.empty()) {
    throw LogicError("footprint of a robot without body parts");
  }
  BodyPart around = body.front();
  around.link = "footprint";
  for (const BodyPart &part : body) {
    around.xMin = std::min(around.xMin, part.xMin);
    around.xMax = std::max(around.xMax, part.xMax);
    around.yMin = std::min(around.yMin, part.yMin);
    around.yMax = std::max(around.yMax, part.yMax);
    around.zMin = std::min(around.zMin, part.zMin);
    around.zMax = std::max(around.zMax, part.zMax);
  }
  return around;
}

RobotDescription parseRobotDescription(const std::string &xml, const std::string &origin)
{
  const urdf::ModelInterfaceSharedPtr model = parseUrdfDocument(xml, origin);
  return Walk(*model, origin).description();
}

} // namespace homeward
