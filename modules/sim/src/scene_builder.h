// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh_file.h"
#include "scene_material.h"
#include "sdf_paths.h"
#include "texture_store.h"

#include <sdf/sdf.hh>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace homeward
{

/** Walks through SDF worlds and models and collects what can be seen and touched. */
class SceneBuilder
{
public:
  /** `paths` must outlive the builder; `worldFile` stands in for files that SDF does not name. */
  SceneBuilder(const SdfPaths &paths, std::filesystem::path worldFile)
      : m_paths(paths), m_worldFile(std::move(worldFile)), m_textures(m_scene),
        m_materials(m_scene, paths, m_textures)
  {}

  void addWorld(const sdf::World &world);

  /** A model with all that is nested in it. It is left out whole where it cannot be meant. */
  void addModel(const sdf::Model &model);

  Scene take() { return std::move(m_scene); }

private:
  using MeshParts = std::vector<MeshPart>;

  void walkModel(const sdf::Model &model, const Eigen::Isometry3d &wMparent,
                 const std::string &name);
  void addVisual(const sdf::Visual &visual, const Eigen::Isometry3d &wMlink,
                 const std::string &model);
  void addCollision(const sdf::Collision &collision, const Eigen::Isometry3d &wMlink,
                    const std::string &model);
  void addLight(const sdf::Light &light, const Eigen::Isometry3d &wMparent);
  void dropIfAbsurd(const std::string &model, std::size_t firstVisual, std::size_t firstCollision);
  std::vector<MeshPart> partsOf(const sdf::Geometry *geometry, const std::string &model);
  std::vector<MeshPart> partsOfMesh(const sdf::Mesh &mesh, const std::string &model);
  const MeshParts *readOnce(const std::filesystem::path &file, const std::string &model);
  int addMaterial(const MeshPart &part, const std::string &model);

  Scene m_scene;
  const SdfPaths &m_paths;
  std::filesystem::path m_worldFile;
  TextureStore m_textures;
  SceneMaterials m_materials;
  std::map<std::filesystem::path, std::optional<MeshParts>> m_meshFiles; ///< nothing: unreadable
};

} // namespace homeward
