// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_file.h"

#include "shading_colour.h"

#include <homeward/core/error.h>

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>

namespace homeward
{

namespace
{

Eigen::Vector3f toEigen(const aiVector3D &v)
{
  return {v.x, v.y, v.z};
}

Mesh convertMesh(const aiMesh &source, const aiMatrix4x4 &transform)
{
  Mesh mesh;
  aiMatrix3x3 normalTransform(transform);
  normalTransform.Inverse().Transpose();
  for (unsigned i = 0; i < source.mNumVertices; ++i) {
    mesh.vertices.push_back(toEigen(transform * source.mVertices[i]));
    if (source.HasNormals()) {
      const Eigen::Vector3f normal = toEigen(normalTransform * source.mNormals[i]);
      const bool usable = normal.allFinite() && normal.squaredNorm() > 0.0F;
      mesh.normals.emplace_back(usable ? normal.normalized() : Eigen::Vector3f::Zero());
    }
    if (source.HasTextureCoords(0)) {
      mesh.uvs.emplace_back(source.mTextureCoords[0][i].x, source.mTextureCoords[0][i].y);
    }
  }
  for (unsigned i = 0; i < source.mNumFaces; ++i) {
    const aiFace &face = source.mFaces[i];
    if (face.mNumIndices == 3) {
      mesh.triangles.emplace_back(static_cast<int>(face.mIndices[0]),
                                  static_cast<int>(face.mIndices[1]),
                                  static_cast<int>(face.mIndices[2]));
    }
  }
  return mesh;
}

void readMaterial(const aiScene &scene, const aiMaterial &source, MeshPart &part)
{
  aiColor3D colour;
  if (source.Get(AI_MATKEY_COLOR_DIFFUSE, colour) == aiReturn_SUCCESS) {
    part.material.diffuse = toLinear(Eigen::Vector3f(colour.r, colour.g, colour.b));
  }
  if (source.Get(AI_MATKEY_COLOR_EMISSIVE, colour) == aiReturn_SUCCESS) {
    part.material.emissive = toLinear(Eigen::Vector3f(colour.r, colour.g, colour.b));
  }
  float opacity = 1.0F;
  if (source.Get(AI_MATKEY_OPACITY, opacity) == aiReturn_SUCCESS) {
    part.material.opacity = std::clamp(opacity, 0.0F, 1.0F);
  }
  aiString texture;
  if (source.GetTexture(aiTextureType_DIFFUSE, 0, &texture) == aiReturn_SUCCESS) {
    part.textureName = texture.C_Str();
    const aiTexture *embedded = scene.GetEmbeddedTexture(texture.C_Str());
    if (embedded != nullptr && embedded->mHeight == 0) {
      const auto *bytes = reinterpret_cast<const unsigned char *>(embedded->pcData);
      part.embeddedTexture.assign(bytes, bytes + embedded->mWidth);
    }
  }
}

void collect(const std::filesystem::path &file, const aiScene &scene, const aiNode &node,
             const aiMatrix4x4 &parent, std::vector<MeshPart> &parts)
{
  const aiMatrix4x4 transform = parent * node.mTransformation;
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    const aiMesh &source = *scene.mMeshes[node.mMeshes[i]];
    MeshPart part;
    part.file = file;
    part.name = source.mName.length > 0 ? source.mName.C_Str() : node.mName.C_Str();
    part.mesh = convertMesh(source, transform);
    readMaterial(scene, *scene.mMaterials[source.mMaterialIndex], part);
    if (!part.mesh.triangles.empty()) {
      parts.push_back(std::move(part));
    }
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) {
    collect(file, scene, *node.mChildren[i], transform, parts);
  }
}

} // namespace

std::vector<MeshPart> readMeshFile(const std::filesystem::path &file)
{
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  importer.SetPropertyFloat(AI_CONFIG_PP_GSN_MAX_SMOOTHING_ANGLE, 45.0F);
  const aiScene *scene =
      importer.ReadFile(file.string(), static_cast<unsigned>(aiProcess_Triangulate) |
                                           aiProcess_JoinIdenticalVertices |
                                           aiProcess_GenSmoothNormals | aiProcess_SortByPType);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    throw RuntimeError(importer.GetErrorString());
  }
  std::vector<MeshPart> parts;
  collect(file, *scene, *scene->mRootNode, aiMatrix4x4(), parts);
  if (parts.empty()) {
    throw RuntimeError("no triangles in it");
  }
  return parts;
}

} // namespace homeward
