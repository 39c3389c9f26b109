// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/sim/scene.h>

#include <string>
#include <vector>

namespace homeward
{

/** One material's share of a mesh file, in the file's own frame, metres. */
struct MeshPart
{
  std::filesystem::path file;                 ///< where it comes from
  std::string name;                           ///< submesh
  Mesh mesh;                                  ///< material and model not set
  Material material;                          ///< texture not set
  std::string textureName;                    ///< as the file has it; empty without
  std::vector<unsigned char> embeddedTexture; ///< a PNG or JPEG inside the file; empty without
};

/**
 * Reads a DAE, OBJ, STL or other mesh file as Gazebo takes it: the unit scales, `up_axis` is
 * ignored.
 * @throw RuntimeError when it cannot be read or has no triangles; the message is the reason only
 */
std::vector<MeshPart> readMeshFile(const std::filesystem::path &file);

} // namespace homeward
