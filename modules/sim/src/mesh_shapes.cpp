// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_shapes.h"

#include <homeward/core/angle.h>

#include <cmath>

namespace homeward
{

namespace
{

constexpr int kAround = 36; ///< facets round a full turn
constexpr int kRings = 18;  ///< facets from pole to pole

/** Adds the rectangle centre +- u +- v with one normal and the whole texture. */
void addQuad(Mesh &mesh, const Eigen::Vector3f &centre, const Eigen::Vector3f &u,
             const Eigen::Vector3f &v)
{
  const int first = static_cast<int>(mesh.vertices.size());
  const Eigen::Vector3f normal = u.cross(v).normalized();
  for (const auto &[a, b] : {std::pair{-1.0F, -1.0F}, {1.0F, -1.0F}, {1.0F, 1.0F}, {-1.0F, 1.0F}}) {
    mesh.vertices.emplace_back(centre + a * u + b * v);
    mesh.normals.push_back(normal);
    mesh.uvs.emplace_back((a + 1.0F) / 2.0F, (b + 1.0F) / 2.0F);
  }
  mesh.triangles.emplace_back(first, first + 1, first + 2);
  mesh.triangles.emplace_back(first, first + 2, first + 3);
}

/** A disc at height z, facing up (side 1) or down (side -1). */
void addDisc(Mesh &mesh, float radius, float z, float side)
{
  const int centre = static_cast<int>(mesh.vertices.size());
  const auto add = [&](float x, float y) {
    mesh.vertices.emplace_back(radius * x, radius * y, z);
    mesh.normals.emplace_back(0.0F, 0.0F, side);
    mesh.uvs.emplace_back((x + 1.0F) / 2.0F, (y + 1.0F) / 2.0F);
  };
  add(0.0F, 0.0F);
  for (int i = 0; i <= kAround; ++i) {
    const auto angle = static_cast<float>(2.0 * kPi * i / kAround);
    add(std::cos(angle), std::sin(angle));
  }
  for (int i = 1; i <= kAround; ++i) {
    mesh.triangles.emplace_back(centre, centre + i, centre + i + 1);
  }
}

/** Joins `rings` + 1 rows of kAround + 1 vertices, just added, with triangles. */
void joinRows(Mesh &mesh, int first, int rings)
{
  for (int ring = 0; ring < rings; ++ring) {
    for (int i = 0; i < kAround; ++i) {
      const int a = first + ring * (kAround + 1) + i;
      const int b = a + kAround + 1;
      mesh.triangles.emplace_back(a, a + 1, b + 1);
      mesh.triangles.emplace_back(a, b + 1, b);
    }
  }
}

} // namespace

Mesh makeBox(const Eigen::Vector3f &size)
{
  Mesh mesh;
  const Eigen::Vector3f x(size.x() / 2.0F, 0.0F, 0.0F);
  const Eigen::Vector3f y(0.0F, size.y() / 2.0F, 0.0F);
  const Eigen::Vector3f z(0.0F, 0.0F, size.z() / 2.0F);
  addQuad(mesh, x, y, z);
  addQuad(mesh, -x, -y, z);
  addQuad(mesh, y, -x, z);
  addQuad(mesh, -y, x, z);
  addQuad(mesh, z, x, y);
  addQuad(mesh, -z, -x, y);
  return mesh;
}

Mesh makeCylinder(float radius, float length)
{
  Mesh mesh;
  for (const float end : {-0.5F, 0.5F}) {
    for (int i = 0; i <= kAround; ++i) {
      const auto angle = static_cast<float>(2.0 * kPi * i / kAround);
      const Eigen::Vector3f out(std::cos(angle), std::sin(angle), 0.0F);
      mesh.vertices.emplace_back(radius * out + Eigen::Vector3f(0.0F, 0.0F, end * length));
      mesh.normals.push_back(out);
      mesh.uvs.emplace_back(static_cast<float>(i) / kAround, end + 0.5F);
    }
  }
  joinRows(mesh, 0, 1);
  addDisc(mesh, radius, length / 2.0F, 1.0F);
  addDisc(mesh, radius, -length / 2.0F, -1.0F);
  return mesh;
}

Mesh makeEllipsoid(const Eigen::Vector3f &radii)
{
  Mesh mesh;
  for (int ring = 0; ring <= kRings; ++ring) {
    const auto latitude = static_cast<float>(kPi * ring / kRings - kPi / 2.0);
    for (int i = 0; i <= kAround; ++i) {
      const auto angle = static_cast<float>(2.0 * kPi * i / kAround);
      const Eigen::Vector3f out(std::cos(latitude) * std::cos(angle),
                                std::cos(latitude) * std::sin(angle), std::sin(latitude));
      mesh.vertices.emplace_back(out.cwiseProduct(radii));
      mesh.normals.push_back(out.cwiseQuotient(radii).normalized());
      mesh.uvs.emplace_back(static_cast<float>(i) / kAround, static_cast<float>(ring) / kRings);
    }
  }
  joinRows(mesh, 0, kRings);
  return mesh;
}

Mesh makeCapsule(float radius, float length)
{
  Mesh mesh = makeEllipsoid(Eigen::Vector3f::Constant(radius));
  for (Eigen::Vector3f &vertex : mesh.vertices) {
    vertex.z() += vertex.z() >= 0.0F ? length / 2.0F : -length / 2.0F;
  }
  return mesh;
}

Mesh makePlane(const Eigen::Vector3f &normal, const Eigen::Vector2f &size)
{
  Mesh mesh;
  const Eigen::Quaternionf turn =
      Eigen::Quaternionf::FromTwoVectors(Eigen::Vector3f::UnitZ(), normal);
  addQuad(mesh, Eigen::Vector3f::Zero(), turn * Eigen::Vector3f(size.x() / 2.0F, 0.0F, 0.0F),
          turn * Eigen::Vector3f(0.0F, size.y() / 2.0F, 0.0F));
  return mesh;
}

} // namespace homeward
