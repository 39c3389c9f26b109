// SPDX-License-Identifier: GPL-3.0-or-later
#include "person.h"

namespace homeward
{

namespace
{

Mesh boxMesh(const Eigen::AlignedBox3f &box)
{
  Mesh mesh;
  for (int corner = 0; corner < 8; ++corner) {
    mesh.vertices.push_back(box.corner(static_cast<Eigen::AlignedBox3f::CornerType>(corner)));
  }
  for (const auto &[a, b, c, d] : std::array<std::array<int, 4>, 6>{
           {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}}}) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  }
  return mesh;
}

} // namespace

PersonColours drawPersonColours(Random &random)
{
  const auto channel = [&] { return static_cast<float>(random.uniform(0.03, 0.7)); };
  const auto colour = [&] {
    const float blue = channel();
    const float green = channel();
    return Eigen::Vector3f(channel(), green, blue);
  };
  const Eigen::Vector3f legs = colour();
  return {legs, colour(), {0.5F, 0.33F, 0.25F}};
}

Eigen::AlignedBox3f personBox(const Eigen::Vector2f &at)
{
  return {Eigen::Vector3f(at.x() - kHalfPerson.x(), at.y() - kHalfPerson.y(), 0.0F),
          Eigen::Vector3f(at.x() + kHalfPerson.x(), at.y() + kHalfPerson.y(), 1.72F)};
}

void addSolidBox(Scene &scene, const std::string &model, const Eigen::AlignedBox3f &box,
                 int material, const Eigen::Affine3f &wMb)
{
  Mesh mesh = boxMesh(box);
  for (Eigen::Vector3f &vertex : mesh.vertices) {
    vertex = wMb * vertex;
  }
  mesh.model = model;
  scene.collisions.push_back(mesh);
  mesh.material = material;
  scene.visuals.push_back(std::move(mesh));
}

void addPerson(Scene &scene, const std::string &name, const Eigen::Vector2f &at,
               const PersonColours &colours)
{
  const Eigen::AlignedBox3f person = personBox(at);
  const std::array<float, 4> heights{person.min().z(), 0.85F, 1.45F, person.max().z()};
  for (std::size_t i = 0; i < colours.size(); ++i) {
    Eigen::AlignedBox3f part = person;
    part.min().z() = heights[i];
    part.max().z() = heights[i + 1];
    scene.materials.push_back({colours[i]});
    addSolidBox(scene, name, part, static_cast<int>(scene.materials.size()) - 1);
  }
}

} // namespace homeward
