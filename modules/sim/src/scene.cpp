// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/sim/scene.h>

#include "scene_builder.h"
#include "sdf_document.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>

namespace homeward
{

Texture makeTexture(const cv::Mat &picture)
{
  Texture texture;
  texture.levels.push_back(picture);
  while (texture.levels.back().rows > 1 || texture.levels.back().cols > 1) {
    const cv::Mat &last = texture.levels.back();
    cv::Mat half;
    cv::resize(last, half, {std::max(1, last.cols / 2), std::max(1, last.rows / 2)}, 0.0, 0.0,
               cv::INTER_AREA);
    texture.levels.push_back(half);
  }
  return texture;
}

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

Scene loadScene(const std::filesystem::path &worldFile)
{
  const SdfPaths paths(worldFile);
  const SdfDocument document = readSdf(worldFile, paths);
  SceneBuilder builder(paths, std::filesystem::absolute(worldFile));
  if (const sdf::World *world = document.root->WorldByIndex(0)) {
    builder.addWorld(*world);
  }
  else {
    builder.addModel(*document.root->Model());
  }
  Scene scene = builder.take();
  if (scene.name.empty() || scene.name == "default") {
    scene.name = worldFile.stem().string();
  }
  scene.problems.insert(scene.problems.begin(), document.problems.begin(), document.problems.end());
  return scene;
}

} // namespace homeward
