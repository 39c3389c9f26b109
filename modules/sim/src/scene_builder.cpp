// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene_builder.h"

#include "mesh_shapes.h"
#include "shading_colour.h"

#include <homeward/core/error.h>

#include <cmath>

namespace homeward
{

namespace
{

constexpr float kEndless = 200.0F; ///< side of the rectangle that stands for a plane, metres
constexpr float kTooFar = 1000.0F; ///< nothing is meant to be this far out, metres
constexpr float kTooHigh = 100.0F; ///< nor this high or deep, metres

Eigen::Vector3f toEigen(const ignition::math::Vector3d &v)
{
  return Eigen::Vector3d(v.X(), v.Y(), v.Z()).cast<float>();
}

Eigen::Vector3f toEigen(const ignition::math::Color &colour)
{
  return {colour.R(), colour.G(), colour.B()};
}

Eigen::Isometry3d toEigen(const ignition::math::Pose3d &pose)
{
  Eigen::Isometry3d aMb = Eigen::Isometry3d::Identity();
  const auto &q = pose.Rot();
  aMb.linear() = Eigen::Quaterniond(q.W(), q.X(), q.Y(), q.Z()).normalized().toRotationMatrix();
  aMb.translation() = Eigen::Vector3d(pose.X(), pose.Y(), pose.Z());
  return aMb;
}

/** Pose of a part in what holds it, whatever frame it is given in. */
template <typename Part> Eigen::Isometry3d poseOf(const Part &part)
{
  ignition::math::Pose3d pose = part.RawPose();
  const sdf::Errors errors = part.SemanticPose().Resolve(pose);
  return toEigen(errors.empty() ? pose : part.RawPose());
}

MeshPart shape(Mesh mesh)
{
  MeshPart part;
  part.mesh = std::move(mesh);
  return part;
}

Mesh placed(Mesh mesh, const Eigen::Isometry3d &wMm, const std::string &model)
{
  const Eigen::Isometry3f pose = wMm.cast<float>();
  for (Eigen::Vector3f &vertex : mesh.vertices) {
    vertex = pose * vertex;
  }
  for (Eigen::Vector3f &normal : mesh.normals) {
    normal = pose.linear() * normal;
  }
  mesh.model = model;
  return mesh;
}

void scaleMesh(Mesh &mesh, const Eigen::Vector3f &scale)
{
  for (Eigen::Vector3f &vertex : mesh.vertices) {
    vertex = vertex.cwiseProduct(scale);
  }
  for (Eigen::Vector3f &normal : mesh.normals) {
    normal = normal.cwiseQuotient(scale).normalized();
  }
}

bool isUsable(const Mesh &mesh)
{
  for (const Eigen::Vector3f &vertex : mesh.vertices) {
    if (!vertex.allFinite()) {
      return false;
    }
  }
  return true;
}

} // namespace

void SceneBuilder::addWorld(const sdf::World &world)
{
  m_scene.name = world.Name();
  if (world.Scene() != nullptr) {
    m_scene.ambient = toEigen(world.Scene()->Ambient());
    m_scene.background = toLinear(toEigen(world.Scene()->Background()));
  }
  for (std::uint64_t i = 0; i < world.ModelCount(); ++i) {
    addModel(*world.ModelByIndex(i));
  }
  for (std::uint64_t i = 0; i < world.LightCount(); ++i) {
    addLight(*world.LightByIndex(i), Eigen::Isometry3d::Identity());
  }
}

void SceneBuilder::addModel(const sdf::Model &model)
{
  const std::size_t firstVisual = m_scene.visuals.size();
  const std::size_t firstCollision = m_scene.collisions.size();
  walkModel(model, Eigen::Isometry3d::Identity(), model.Name());
  dropIfAbsurd(model.Name(), firstVisual, firstCollision);
}

void SceneBuilder::walkModel(const sdf::Model &model, const Eigen::Isometry3d &wMparent,
                             const std::string &name)
{
  const Eigen::Isometry3d wMm = wMparent * poseOf(model);
  for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
    const sdf::Link &link = *model.LinkByIndex(i);
    const Eigen::Isometry3d wMl = wMm * poseOf(link);
    for (std::uint64_t k = 0; k < link.VisualCount(); ++k) {
      addVisual(*link.VisualByIndex(k), wMl, name);
    }
    for (std::uint64_t k = 0; k < link.CollisionCount(); ++k) {
      addCollision(*link.CollisionByIndex(k), wMl, name);
    }
    for (std::uint64_t k = 0; k < link.LightCount(); ++k) {
      addLight(*link.LightByIndex(k), wMl);
    }
  }
  for (std::uint64_t i = 0; i < model.ModelCount(); ++i) {
    walkModel(*model.ModelByIndex(i), wMm, name);
  }
}

void SceneBuilder::addVisual(const sdf::Visual &visual, const Eigen::Isometry3d &wMlink,
                             const std::string &model)
{
  const Eigen::Isometry3d wMv = wMlink * poseOf(visual);
  const std::optional<Material> own = m_materials.read(visual, model);
  for (MeshPart &part : partsOf(visual.Geom(), model)) {
    if (own) {
      part.material = *own;
      part.textureName.clear();
    }
    part.material.opacity *= 1.0F - visual.Transparency();
    Mesh mesh = placed(std::move(part.mesh), wMv, model);
    mesh.material = addMaterial(part, model);
    m_scene.visuals.push_back(std::move(mesh));
  }
}

void SceneBuilder::addCollision(const sdf::Collision &collision, const Eigen::Isometry3d &wMlink,
                                const std::string &model)
{
  const Eigen::Isometry3d wMc = wMlink * poseOf(collision);
  for (MeshPart &part : partsOf(collision.Geom(), model)) {
    part.mesh.normals.clear();
    part.mesh.uvs.clear();
    m_scene.collisions.push_back(placed(std::move(part.mesh), wMc, model));
  }
}

int SceneBuilder::addMaterial(const MeshPart &part, const std::string &model)
{
  Material material = part.material;
  if (!part.textureName.empty()) {
    material.texture =
        part.embeddedTexture.empty()
            ? m_textures.load(part.textureName, part.file, model)
            : m_textures.decode(part.embeddedTexture, part.textureName, part.file, model);
    if (material.texture >= 0) {
      material.diffuse.setOnes();
    }
  }
  m_scene.materials.push_back(material);
  return static_cast<int>(m_scene.materials.size()) - 1;
}

void SceneBuilder::addLight(const sdf::Light &light, const Eigen::Isometry3d &wMparent)
{
  const Eigen::Isometry3d wMl = wMparent * poseOf(light);
  Light added;
  added.kind = light.Type() == sdf::LightType::DIRECTIONAL ? Light::Kind::Directional
               : light.Type() == sdf::LightType::SPOT      ? Light::Kind::Spot
                                                           : Light::Kind::Point;
  added.position = wMl.translation().cast<float>();
  const Eigen::Vector3f direction = wMl.linear().cast<float>() * toEigen(light.Direction());
  added.direction = direction.squaredNorm() > 0.0F ? Eigen::Vector3f(direction.normalized())
                                                   : Eigen::Vector3f(0.0F, 0.0F, -1.0F);
  added.colour = toEigen(light.Diffuse()) * static_cast<float>(light.Intensity());
  added.range = static_cast<float>(light.AttenuationRange());
  added.constant = static_cast<float>(light.ConstantAttenuationFactor());
  added.linear = static_cast<float>(light.LinearAttenuationFactor());
  added.quadratic = static_cast<float>(light.QuadraticAttenuationFactor());
  added.innerAngle = static_cast<float>(light.SpotInnerAngle().Radian());
  added.outerAngle = static_cast<float>(light.SpotOuterAngle().Radian());
  added.castsShadows = light.CastShadows();
  m_scene.lights.push_back(added);
}

void SceneBuilder::dropIfAbsurd(const std::string &model, std::size_t firstVisual,
                                std::size_t firstCollision)
{
  const auto visuals = m_scene.visuals.begin() + static_cast<std::ptrdiff_t>(firstVisual);
  const auto collisions = m_scene.collisions.begin() + static_cast<std::ptrdiff_t>(firstCollision);
  std::vector<Mesh> meshes(visuals, m_scene.visuals.end());
  meshes.insert(meshes.end(), collisions, m_scene.collisions.end());
  const Eigen::AlignedBox3f box = boundsOf(meshes);
  if (box.isEmpty()) {
    return;
  }
  std::string why;
  if (std::max(box.max().cwiseAbs().maxCoeff(), box.min().cwiseAbs().maxCoeff()) > kTooFar) {
    why = "it reaches more than 1 km from the world's origin";
  }
  else if (box.min().z() > kTooHigh || box.max().z() < -kTooHigh) {
    why = "it stands more than 100 m above or below the world's origin";
  }
  if (!why.empty()) {
    m_scene.visuals.erase(visuals, m_scene.visuals.end());
    m_scene.collisions.erase(collisions, m_scene.collisions.end());
    m_scene.problems.push_back("model '" + model + "': left out: " + why);
  }
}

std::vector<MeshPart> SceneBuilder::partsOf(const sdf::Geometry *geometry, const std::string &model)
{
  if (geometry == nullptr) {
    return {};
  }
  if (const sdf::Box *box = geometry->BoxShape()) {
    return {shape(makeBox(toEigen(box->Size())))};
  }
  if (const sdf::Cylinder *cylinder = geometry->CylinderShape()) {
    return {shape(makeCylinder(static_cast<float>(cylinder->Radius()),
                               static_cast<float>(cylinder->Length())))};
  }
  if (const sdf::Sphere *sphere = geometry->SphereShape()) {
    return {shape(makeEllipsoid(Eigen::Vector3f::Constant(static_cast<float>(sphere->Radius()))))};
  }
  if (const sdf::Ellipsoid *ellipsoid = geometry->EllipsoidShape()) {
    return {shape(makeEllipsoid(toEigen(ellipsoid->Radii())))};
  }
  if (const sdf::Capsule *capsule = geometry->CapsuleShape()) {
    return {shape(
        makeCapsule(static_cast<float>(capsule->Radius()), static_cast<float>(capsule->Length())))};
  }
  if (const sdf::Plane *plane = geometry->PlaneShape()) {
    MeshPart part = shape(makePlane(toEigen(plane->Normal()), {kEndless, kEndless}));
    part.mesh.infinite = true;
    return {part};
  }
  if (const sdf::Mesh *mesh = geometry->MeshShape()) {
    return partsOfMesh(*mesh, model);
  }
  if (geometry->Type() != sdf::GeometryType::EMPTY) {
    m_scene.problems.push_back("model '" + model +
                               "': geometry left out: only box, capsule, cylinder, ellipsoid, "
                               "mesh, plane and sphere are known");
  }
  return {};
}

std::vector<MeshPart> SceneBuilder::partsOfMesh(const sdf::Mesh &mesh, const std::string &model)
{
  const std::string beside = mesh.FilePath().empty() ? m_worldFile.string() : mesh.FilePath();
  const std::optional<std::filesystem::path> file = m_paths.find(mesh.Uri(), beside);
  if (!file) {
    m_scene.problems.push_back("model '" + model + "': mesh '" + mesh.Uri() +
                               "' not found; left out");
    return {};
  }
  const MeshParts *read = readOnce(*file, model);
  std::vector<MeshPart> parts = read == nullptr ? MeshParts() : *read;
  if (!mesh.Submesh().empty()) {
    std::erase_if(parts, [&](const MeshPart &part) { return part.name != mesh.Submesh(); });
  }
  for (MeshPart &part : parts) {
    if (mesh.CenterSubmesh() && !mesh.Submesh().empty()) {
      const Eigen::Vector3f centre = boundsOf({part.mesh}).center();
      for (Eigen::Vector3f &vertex : part.mesh.vertices) {
        vertex -= centre;
      }
    }
    scaleMesh(part.mesh, toEigen(mesh.Scale()));
  }
  return parts;
}

const SceneBuilder::MeshParts *SceneBuilder::readOnce(const std::filesystem::path &file,
                                                      const std::string &model)
{
  const auto [entry, isNew] = m_meshFiles.try_emplace(file);
  if (isNew) {
    try {
      MeshParts parts = readMeshFile(file);
      std::erase_if(parts, [](const MeshPart &part) { return !isUsable(part.mesh); });
      entry->second = std::move(parts);
    }
    catch (const RuntimeError &error) {
      m_scene.problems.push_back("model '" + model + "': mesh '" + file.string() +
                                 "' cannot be read; left out: " + error.what());
    }
  }
  return entry->second ? &*entry->second : nullptr;
}

} // namespace homeward
