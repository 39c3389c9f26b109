// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/evaluation/changed_scene.h>

#include "person.h"

#include <homeward/core/angle.h>
#include <homeward/core/random.h>

#include <algorithm>
#include <map>
#include <string>

namespace homeward
{

namespace
{

using Box = Eigen::AlignedBox3f;

constexpr std::uint32_t kChangeStream = 403;
constexpr float kClear = 0.6F;  // metres from a view
constexpr float kAbove = 0.05F; // metres; what is lower is floor
constexpr int kTries = 40;

class Change
{
public:
  Change(const Scene &scene, const FreeSpace &space, const std::vector<Pose2> &views,
         std::uint64_t seed)
      : m_space(space), m_views(views), m_random(seed, kChangeStream)
  {
    m_result.scene = scene;
    for (const std::vector<Mesh> *meshes : {&scene.visuals, &scene.collisions}) {
      for (const Mesh &mesh : *meshes) {
        if (!mesh.infinite) {
          m_boxes[mesh.model].extend(boundsOf({mesh}));
          m_parts.push_back({mesh.model, boundsOf({mesh})});
        }
      }
    }
  }

  void moveFurniture(double distance)
  {
    for (const auto &[model, box] : m_boxes) {
      if (isChair(box)) {
        move(model, box, distance);
      }
    }
  }

  void addPeople(std::size_t count)
  {
    const std::vector<Eigen::Vector2d> &cells = m_space.reachableCells();
    for (int i = 0;
         !cells.empty() && m_result.people < count && i < kTries * static_cast<int>(count); ++i) {
      const double share = m_random.uniform(0.0, static_cast<double>(cells.size()));
      const auto cell = std::min(cells.size() - 1, static_cast<std::size_t>(share));
      const Eigen::Vector2f at = cells[cell].cast<float>();
      if (fits("", personBox(at))) {
        addPersonAt(at);
      }
    }
  }

  ChangedScene take() { return std::move(m_result); }

private:
  struct Part
  {
    std::string model;
    Box box;
  };

  static bool isChair(const Box &box)
  {
    const Eigen::Vector3f size = box.sizes();
    return std::max(size.x(), size.y()) <= 1.1F && size.z() >= 0.3F && size.z() <= 1.4F &&
           box.min().z() < 0.15F;
  }

  /** Whether a box meets no other model and no view. */
  bool fits(const std::string &model, const Box &box) const
  {
    Box body = box;
    body.min().z() = std::max(body.min().z(), kAbove);
    const auto near = [&](const Pose2 &view) {
      const Eigen::Vector3f at(static_cast<float>(view.x), static_cast<float>(view.y),
                               body.center().z());
      return body.exteriorDistance(at) < kClear;
    };
    const auto meets = [&](const Part &part) {
      return part.model != model && part.box.max().z() > kAbove && part.box.intersects(body) &&
             !isFloor(part.box);
    };
    return std::none_of(m_views.begin(), m_views.end(), near) &&
           std::none_of(m_parts.begin(), m_parts.end(), meets);
  }

  /** Rooms made of one mesh have everything in their box. */
  static bool isFloor(const Box &box) { return box.sizes().x() > 3.0F && box.sizes().y() > 3.0F; }

  void move(const std::string &model, const Box &box, double distance)
  {
    for (int i = 0; i < kTries; ++i) {
      const double way = m_random.uniform(-kPi, kPi);
      const Eigen::Vector3f shift(static_cast<float>(distance * std::cos(way)),
                                  static_cast<float>(distance * std::sin(way)), 0.0F);
      const Eigen::Vector3f middle = box.center();
      const auto turn = static_cast<float>(m_random.uniform(-kPi, kPi));
      const float reach = 0.5F * box.sizes().head<2>().norm();
      const Box there(
          Eigen::Vector3f(middle.x() - reach, middle.y() - reach, box.min().z()) + shift,
          Eigen::Vector3f(middle.x() + reach, middle.y() + reach, box.max().z()) + shift);
      const Eigen::Vector2d place = (middle + shift).head<2>().cast<double>();
      if (m_space.grid().free(place) && fits(model, there)) {
        apply(model, Eigen::Translation3f(middle + shift) *
                         Eigen::AngleAxisf(turn, Eigen::Vector3f::UnitZ()) *
                         Eigen::Translation3f(-middle));
        std::erase_if(m_parts, [&](const Part &part) { return part.model == model; });
        m_parts.push_back({model, there});
        m_result.moved.push_back(there);
        return;
      }
    }
  }

  void apply(const std::string &model, const Eigen::Isometry3f &motion)
  {
    for (std::vector<Mesh> *meshes : {&m_result.scene.visuals, &m_result.scene.collisions}) {
      for (Mesh &mesh : *meshes) {
        if (mesh.model == model) {
          for (Eigen::Vector3f &vertex : mesh.vertices) {
            vertex = motion * vertex;
          }
          for (Eigen::Vector3f &normal : mesh.normals) {
            normal = motion.linear() * normal;
          }
        }
      }
    }
  }

  void addPersonAt(const Eigen::Vector2f &at)
  {
    const std::string name = "person_" + std::to_string(m_result.people++);
    addPerson(m_result.scene, name, at, drawPersonColours(m_random));
    m_parts.push_back({name, personBox(at)});
  }

  const FreeSpace &m_space;
  const std::vector<Pose2> &m_views;
  Random m_random;
  ChangedScene m_result;
  std::map<std::string, Box> m_boxes; ///< by model
  std::vector<Part> m_parts;
};

} // namespace

ChangedScene changeScene(const Scene &scene, const FreeSpace &space,
                         const std::vector<Pose2> &views, const SceneChange &change,
                         std::uint64_t seed)
{
  Change made(scene, space, views, seed);
  if (change.moveFurniture > 0.0) {
    made.moveFurniture(change.moveFurniture);
  }
  made.addPeople(change.people);
  return made.take();
}

} // namespace homeward
