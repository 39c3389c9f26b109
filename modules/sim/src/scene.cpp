// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/sim/scene.h>

namespace homeward
{

Eigen::AlignedBox3f boundsOf(const std::vector<Mesh> &meshes)
{
  Eigen::AlignedBox3f bounds;
  for (const Mesh &mesh : meshes) {
    if (mesh.infinite) {
      continue;
    }
    for (const Eigen::Vector3f &vertex : mesh.vertices) {
      bounds.extend(vertex);
    }
  }
  return bounds;
}

} // namespace homeward
