// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sdf_paths.h"
#include "texture_store.h"

#include <sdf/Visual.hh>

#include <optional>
#include <string>

namespace homeward
{

/**
 * The material that an SDF visual asks for: a colour, a texture, a Gazebo name, or a material
 * script. Nothing when it leaves the choice to its mesh.
 */
class SceneMaterials
{
public:
  SceneMaterials(Scene &scene, const SdfPaths &paths, TextureStore &textures)
      : m_scene(scene), m_paths(paths), m_textures(textures)
  {}

  std::optional<Material> read(const sdf::Visual &visual, const std::string &model);

private:
  std::optional<Material> readScript(const sdf::Material &source, const std::string &model);
  std::optional<Material> findInScripts(const sdf::Material &source, const std::string &model);

  Scene &m_scene;
  const SdfPaths &m_paths;
  TextureStore &m_textures;
};

/** The colour, linear RGB, of one of Gazebo's own materials such as `Gazebo/Grey`. */
std::optional<Eigen::Vector3f> gazeboColour(const std::string &name);

} // namespace homeward
