// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/sim/scene.h>

#include <memory>
#include <optional>

namespace homeward
{

class EmbreeScene;

/** Where a ray meets a scene. */
struct RayHit
{
  float range;            ///< metres along the unit direction
  int mesh;               ///< index into the layer's meshes
  int triangle;           ///< index into Mesh::triangles
  Eigen::Vector2f weight; ///< weights of the triangle's second and third corner
  Eigen::Vector3f normal; ///< unit, of the triangle, on the side where the ray comes from
};

/** Answers what a straight line meets in a scene. Safe to ask from several threads. */
class RayCaster
{
public:
  /** Which meshes of the scene rays meet: Scene::visuals or Scene::collisions. */
  enum class Layer
  {
    Visual,
    Collision
  };

  /** Builds the search tree over one layer: some tens of milliseconds per 100,000 triangles. */
  RayCaster(std::shared_ptr<const Scene> scene, Layer layer);
  ~RayCaster();
  RayCaster(RayCaster &&) noexcept;
  RayCaster &operator=(RayCaster &&) noexcept;

  /**
   * Distance from `origin` to the first surface, from either side.
   * @param origin metres, world frame
   * @param direction world frame, any length but zero
   * @param maxRange metres
   * @return metres; infinity when nothing is met within maxRange
   */
  float range(const Eigen::Vector3f &origin, const Eigen::Vector3f &direction,
              float maxRange) const;

  /** As range(), with what was met. */
  std::optional<RayHit> hit(const Eigen::Vector3f &origin, const Eigen::Vector3f &direction,
                            float maxRange) const;

  /** Whether anything stands on the straight line between two points. Metres, world frame. */
  bool blocked(const Eigen::Vector3f &from, const Eigen::Vector3f &to) const;

  /** The world that it was made of. */
  const Scene &scene() const { return *m_scene; }

  /** The meshes that RayHit::mesh counts. */
  const std::vector<Mesh> &meshes() const;

private:
  std::shared_ptr<const Scene> m_scene;
  Layer m_layer;
  std::unique_ptr<EmbreeScene> m_embree;
};

} // namespace homeward
