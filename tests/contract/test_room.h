// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/sim/scene.h>

#include <array>
#include <memory>

namespace homeward
{

/** An upright box from one corner to the other, triangles counter-clockwise seen from outside. */
inline Mesh boxMesh(const Eigen::Vector3f &low, const Eigen::Vector3f &high)
{
  Mesh mesh;
  mesh.model = "box";
  for (int corner = 0; corner < 8; ++corner) {
    mesh.vertices.emplace_back((corner & 1) != 0 ? high.x() : low.x(),
                               (corner & 2) != 0 ? high.y() : low.y(),
                               (corner & 4) != 0 ? high.z() : low.z());
  }
  constexpr std::array<std::array<int, 4>, 6> kFaces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto &face : kFaces) {
    mesh.triangles.emplace_back(face[0], face[1], face[2]);
    mesh.triangles.emplace_back(face[0], face[2], face[3]);
  }
  return mesh;
}

/** Adds a box to what can be seen and what can be touched, in a colour of linear RGB. */
inline void addBox(Scene &scene, const Eigen::Vector3f &low, const Eigen::Vector3f &high,
                   const Eigen::Vector3f &colour = {0.5F, 0.5F, 0.5F})
{
  Mesh mesh = boxMesh(low, high);
  scene.collisions.push_back(mesh);
  mesh.material = static_cast<int>(scene.materials.size());
  scene.visuals.push_back(mesh);
  Material material;
  material.diffuse = colour;
  scene.materials.push_back(material);
}

/**
 * A room between x = 0 and width, y = 0 and depth, with walls of 10 cm, 2.5 m high, standing on an
 * endless floor.
 */
inline Scene makeRoom(float width, float depth)
{
  constexpr float kWall = 0.1F;
  constexpr float kHeight = 2.5F;
  Scene scene;
  scene.name = "room";
  addBox(scene, {-500.0F, -500.0F, -0.1F}, {500.0F, 500.0F, 0.0F});
  scene.visuals.back().infinite = true;
  scene.collisions.back().infinite = true;
  addBox(scene, {-kWall, -kWall, 0.0F}, {width + kWall, 0.0F, kHeight});
  addBox(scene, {-kWall, depth, 0.0F}, {width + kWall, depth + kWall, kHeight});
  addBox(scene, {-kWall, 0.0F, 0.0F}, {0.0F, depth, kHeight});
  addBox(scene, {width, 0.0F, 0.0F}, {width + kWall, depth, kHeight});
  return scene;
}

inline std::shared_ptr<const Scene> share(Scene scene)
{
  return std::make_shared<const Scene>(std::move(scene));
}

} // namespace homeward
