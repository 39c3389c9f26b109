// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace homeward
{

/** A picture to put on a surface. */
struct Texture
{
  /** CV_8UC3 BGR, sRGB-coded; level 0 is the full picture, each next one half as wide and high. */
  std::vector<cv::Mat> levels;
};

/** The picture, CV_8UC3, and its halvings down to one pixel. */
Texture makeTexture(const cv::Mat &picture);

/** How a surface reflects light. Both sides of a triangle look the same. */
struct Material
{
  Eigen::Vector3f diffuse{0.5F, 0.5F, 0.5F};  ///< linear RGB; multiplies the texture
  Eigen::Vector3f emissive{0.0F, 0.0F, 0.0F}; ///< linear RGB radiance given off in any light
  int texture = -1;                           ///< index into Scene::textures, -1 without
  float opacity = 1.0F;                       ///< 0 to 1; sensors see through what is below 0.6
};

/** Triangles of one material, in the world frame. */
struct Mesh
{
  std::string model;                      ///< name of the model it belongs to
  std::vector<Eigen::Vector3f> vertices;  ///< metres
  std::vector<Eigen::Vector3f> normals;   ///< unit, one a vertex; empty: the triangle's own
  std::vector<Eigen::Vector2f> uvs;       ///< one a vertex, v grows upwards; empty without
  std::vector<Eigen::Vector3i> triangles; ///< indices of vertices
  int material = -1;                      ///< index into Scene::materials, -1 for collisions
  bool infinite = false;                  ///< stands for an endless plane; not part of bounds
};

/** A lamp, or the sun. */
struct Light
{
  /** Where its light comes from. */
  enum class Kind
  {
    Point,
    Spot,
    Directional
  };
  Kind kind = Kind::Point;                      ///< where its light comes from
  Eigen::Vector3f position{0.0F, 0.0F, 0.0F};   ///< metres, world frame
  Eigen::Vector3f direction{0.0F, 0.0F, -1.0F}; ///< unit, the way the light goes, world frame
  Eigen::Vector3f colour{1.0F, 1.0F, 1.0F};     ///< linear RGB at attenuation 1
  float range = 10.0F;                          ///< metres, no light beyond
  float constant = 1.0F;                        ///< attenuation 1 / (constant + linear d + ...
  float linear = 0.0F;                          ///< ... per metre
  float quadratic = 0.0F;                       ///< ... per square metre)
  float innerAngle = 0.0F;                      ///< full cone of full light, radians (Spot)
  float outerAngle = 0.0F;                      ///< full cone of any light, radians (Spot)
  bool castsShadows = true;                     ///< things in its way do
};

/** Everything a simulated sensor can see or touch. World frame, metres, z up. */
struct Scene
{
  std::string name;                             ///< as its file has it
  std::vector<Mesh> visuals;                    ///< what a camera sees
  std::vector<Mesh> collisions;                 ///< what a laser and a bumper meet
  std::vector<Material> materials;              ///< that meshes name by index
  std::vector<Texture> textures;                ///< that materials name by index
  std::vector<Light> lights;                    ///< as the file has them
  Eigen::Vector3f ambient{0.4F, 0.4F, 0.4F};    ///< linear RGB of the light from everywhere
  Eigen::Vector3f background{0.7F, 0.7F, 0.7F}; ///< linear RGB where a ray meets nothing
  std::vector<std::string> problems; ///< one line for each model, mesh or texture left out
};

/** The smallest box round all meshes but the infinite ones; empty when there are none. Metres. */
Eigen::AlignedBox3f boundsOf(const std::vector<Mesh> &meshes);

/**
 * Reads a Gazebo world: SDF, with the models, meshes and textures it names.
 *
 * `model://NAME` is looked for below the world's folder, `models` in it, `models` beside it, and
 * each folder of GAZEBO_MODEL_PATH and SDF_PATH. What is broken or missing is left out, or drawn in
 * a plain colour, and named in Scene::problems; the rest loads.
 * @param worldFile an SDF file with a `<world>`, or a single `<model>`
 * @throw ConfigError when the file is missing or not SDF at all
 */
Scene loadScene(const std::filesystem::path &worldFile);

} // namespace homeward
