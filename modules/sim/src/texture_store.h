// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/sim/scene.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace homeward
{

/** Loads each texture of a scene once. */
class TextureStore
{
public:
  /** Textures and problems go to `scene`, which must outlive the store. */
  explicit TextureStore(Scene &scene) : m_scene(scene) {}

  /**
   * Index into Scene::textures, or -1 with a line in Scene::problems.
   *
   * The name is tried as a path beside the file; then its file name anywhere below the model, then
   * below the models' folder and a `photos` folder beside that.
   * @param named as the file has it, any kind of slashes
   * @param besideFile the mesh or SDF file that names it
   * @param model for messages
   */
  int load(const std::string &named, const std::filesystem::path &besideFile,
           const std::string &model);

  /** A texture found inside a mesh file. */
  int decode(const std::vector<unsigned char> &bytes, const std::string &named,
             const std::filesystem::path &besideFile, const std::string &model);

private:
  using FileIndex = std::map<std::string, std::filesystem::path>;

  const FileIndex &filesBelow(const std::filesystem::path &folder);
  std::optional<std::filesystem::path> find(const std::string &named,
                                            const std::filesystem::path &besideFile);
  int add(const std::string &key, const cv::Mat &picture, const std::string &model);

  Scene &m_scene;
  std::map<std::string, int> m_loaded;                  ///< by full path; -1 unreadable
  std::map<std::filesystem::path, FileIndex> m_indices; ///< by folder; keys are lower-case names
};

} // namespace homeward
