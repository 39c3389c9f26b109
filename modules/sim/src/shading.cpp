// SPDX-License-Identifier: GPL-3.0-or-later
#include "shading.h"

#include "shading_texture.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace homeward
{

namespace
{

constexpr float kShadowOffset = 2e-3F; ///< start of a shadow ray above its surface, metres
constexpr float kNegligible = 0.01F;   ///< a lamp below this share of the light so far is skipped
constexpr float kLampBody = 0.3F;      ///< shadows are not cast from nearer to a lamp, metres

/** Texels a metre along each triangle of a mesh; empty without texture. */
std::vector<float> texelDensity(const Scene &scene, const Mesh &mesh)
{
  const int texture =
      mesh.material < 0 ? -1 : scene.materials[static_cast<std::size_t>(mesh.material)].texture;
  if (texture < 0 || mesh.uvs.empty()) {
    return {};
  }
  const cv::Mat &picture = scene.textures[static_cast<std::size_t>(texture)].levels.front();
  std::vector<float> density;
  density.reserve(mesh.triangles.size());
  for (const Eigen::Vector3i &triangle : mesh.triangles) {
    const auto corner = [&](const auto &list, int i) {
      return list[static_cast<std::size_t>(triangle[i])];
    };
    const Eigen::Vector3f a = corner(mesh.vertices, 1) - corner(mesh.vertices, 0);
    const Eigen::Vector3f b = corner(mesh.vertices, 2) - corner(mesh.vertices, 0);
    const Eigen::Vector2f s = corner(mesh.uvs, 1) - corner(mesh.uvs, 0);
    const Eigen::Vector2f t = corner(mesh.uvs, 2) - corner(mesh.uvs, 0);
    const float texels = std::abs(s.x() * t.y() - s.y() * t.x()) *
                         static_cast<float>(picture.cols) * static_cast<float>(picture.rows);
    const float area = a.cross(b).norm();
    density.push_back(area > 0.0F ? std::sqrt(texels / area) : 0.0F);
  }
  return density;
}

template <typename Value>
Value interpolate(const std::vector<Value> &values, const Eigen::Vector3i &triangle, float u,
                  float v)
{
  const auto at = [&](int i) -> const Value & {
    return values[static_cast<std::size_t>(triangle[i])];
  };
  return at(0) * (1.0F - u - v) + at(1) * u + at(2) * v;
}

/** Brightness of a lamp at a distance, before its colour. */
Lanes attenuation(const Light &light, const Lanes &distance)
{
  const Lanes fall = light.constant + distance * (light.linear + distance * light.quadratic);
  // Fade over the last tenth of the range, lest a ring shows where it ends.
  const Lanes edge = ((light.range - distance) / (0.1F * light.range)).max(0.0F).min(1.0F);
  return edge / fall.max(1e-3F);
}

/** Share of a spot's light at cosines of the angle off its axis. */
Lanes spotShare(const Light &light, const Lanes &cosine)
{
  const float inner = std::cos(light.innerAngle / 2.0F);
  const float outer = std::cos(light.outerAngle / 2.0F);
  return ((cosine - outer) / std::max(inner - outer, 1e-4F)).max(0.0F).min(1.0F);
}

} // namespace

/** What the rays of a packet meet. */
struct Shader::Surfaces
{
  std::array<Lanes, 3> position; ///< lifted off the surface by kShadowOffset
  std::array<Lanes, 3> normal;   ///< unit, towards the viewer; zero where nothing is met
  std::array<Lanes, 3> light;    ///< irradiance over pi, RGB
  std::array<Eigen::Vector3f, kPacket> albedo;
  std::array<Eigen::Vector3f, kPacket> emissive;
  std::array<bool, kPacket> hit{};

  Surfaces()
  {
    for (std::array<Lanes, 3> *lanes : {&position, &normal, &light}) {
      lanes->fill(Lanes::Zero());
    }
  }
};

Shader::Layer::Layer(std::shared_ptr<const Scene> visible, unsigned first)
    : scene(std::move(visible)), firstId(first), embree(*scene, scene->visuals, first)
{
  texelDensity.reserve(scene->visuals.size());
  for (const Mesh &mesh : scene->visuals) {
    texelDensity.push_back(homeward::texelDensity(*scene, mesh));
  }
}

Shader::Shader(std::shared_ptr<const Scene> scene, const Lighting &lighting, bool shadows)
    : m_building(std::move(scene), 0U), m_lighting(lighting), m_shadows(shadows)
{}

void Shader::put(std::shared_ptr<const Scene> things)
{
  const auto first = static_cast<unsigned>(m_building.scene->visuals.size());
  m_things = things ? std::make_unique<const Layer>(std::move(things), first) : nullptr;
}

RadiancePacket Shader::radiance(const Eigen::Vector3f &origin, const RayPacket &rays) const
{
  alignas(64) std::array<int, kPacket> valid{};
  alignas(64) RTCRayHit16 hits{};
  for (int i = 0; i < rays.count; ++i) {
    valid[static_cast<std::size_t>(i)] = -1;
    hits.ray.org_x[i] = origin.x();
    hits.ray.org_y[i] = origin.y();
    hits.ray.org_z[i] = origin.z();
    const Eigen::Vector3f &direction = rays.directions[static_cast<std::size_t>(i)];
    hits.ray.dir_x[i] = direction.x();
    hits.ray.dir_y[i] = direction.y();
    hits.ray.dir_z[i] = direction.z();
    hits.ray.tfar[i] = std::numeric_limits<float>::infinity();
    hits.ray.mask[i] = ~0U;
    hits.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect16(valid.data(), m_building.embree.scene(), &context, &hits);
  if (m_things) {
    // The rays end where they met the building, so only what is nearer counts.
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect16(valid.data(), m_things->embree.scene(), &context, &hits);
  }

  Surfaces surfaces;
  for (int i = 0; i < rays.count; ++i) {
    readSurface(hits, i, origin, rays, surfaces);
  }
  for (const Light &light : m_lighting.lights) {
    addLight(light, surfaces);
  }
  RadiancePacket radiance;
  for (std::size_t i = 0; i < static_cast<std::size_t>(rays.count); ++i) {
    const auto lane = static_cast<Eigen::Index>(i);
    const Eigen::Vector3f light(surfaces.light[0][lane], surfaces.light[1][lane],
                                surfaces.light[2][lane]);
    radiance[i] =
        surfaces.hit[i]
            ? Eigen::Vector3f(surfaces.albedo[i].cwiseProduct(light) + surfaces.emissive[i])
            : m_lighting.background;
  }
  return radiance;
}

void Shader::readSurface(const RTCRayHit16 &hits, int lane, const Eigen::Vector3f &origin,
                         const RayPacket &rays, Surfaces &surfaces) const
{
  const auto i = static_cast<std::size_t>(lane);
  if (hits.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID) {
    return;
  }
  surfaces.hit[i] = true;
  const bool ofBuilding = hits.hit.geomID[lane] < m_building.scene->visuals.size();
  const Layer &layer = ofBuilding ? m_building : *m_things;
  const std::size_t meshIndex = hits.hit.geomID[lane] - layer.firstId;
  const Mesh &mesh = layer.scene->visuals[meshIndex];
  const std::size_t triangleIndex = hits.hit.primID[lane];
  const Eigen::Vector3i &triangle = mesh.triangles[triangleIndex];
  const float u = hits.hit.u[lane];
  const float v = hits.hit.v[lane];
  const Eigen::Vector3f &direction = rays.directions[i];
  Eigen::Vector3f flat(hits.hit.Ng_x[lane], hits.hit.Ng_y[lane], hits.hit.Ng_z[lane]);
  flat.normalize();
  const float cosine = -flat.dot(direction);
  if (cosine < 0.0F) {
    flat = -flat;
  }
  Eigen::Vector3f normal = flat;
  if (!mesh.normals.empty()) {
    const Eigen::Vector3f smooth = interpolate(mesh.normals, triangle, u, v);
    if (const float length = smooth.norm(); length > 0.1F) {
      normal = smooth / (smooth.dot(flat) < 0.0F ? -length : length);
    }
  }
  const float range = hits.ray.tfar[lane];
  const Eigen::Vector3f position = origin + range * direction + kShadowOffset * flat;
  const float upward = 0.5F + 0.5F * normal.z();
  for (int axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    surfaces.position[k][lane] = position[axis];
    surfaces.normal[k][lane] = normal[axis];
    surfaces.light[k][lane] =
        upward * m_lighting.sky[axis] + (1.0F - upward) * m_lighting.ground[axis];
  }

  const Material &material = layer.scene->materials[static_cast<std::size_t>(mesh.material)];
  surfaces.albedo[i] = material.diffuse;
  surfaces.emissive[i] = material.emissive;
  const std::vector<float> &density = layer.texelDensity[meshIndex];
  if (!density.empty()) {
    // The geometric mean of the footprint's two axes, a bit sharper than the longer one.
    const float width = range * rays.spread[i] / std::sqrt(std::max(std::abs(cosine), 0.05F));
    surfaces.albedo[i] = surfaces.albedo[i].cwiseProduct(
        sampleTexture(layer.scene->textures[static_cast<std::size_t>(material.texture)],
                      interpolate(mesh.uvs, triangle, u, v), width * density[triangleIndex]));
  }
}

void Shader::addLight(const Light &light, Surfaces &surfaces) const
{
  const bool isSun = light.kind == Light::Kind::Directional;
  std::array<Lanes, 3> way; // towards the lamp
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    way[k] = isSun ? Lanes(Lanes::Constant(-light.direction[axis]))
                   : Lanes(light.position[axis] - surfaces.position[k]);
  }
  const Lanes distance = (way[0].square() + way[1].square() + way[2].square()).max(1e-12F).sqrt();
  Lanes strength =
      (surfaces.normal[0] * way[0] + surfaces.normal[1] * way[1] + surfaces.normal[2] * way[2]) /
      distance;
  if (!isSun) {
    strength *= attenuation(light, distance);
  }
  if (light.kind == Light::Kind::Spot) {
    strength *= spotShare(light, -(way[0] * light.direction.x() + way[1] * light.direction.y() +
                                   way[2] * light.direction.z()) /
                                     distance);
  }
  const Lanes sofar = surfaces.light[0].max(surfaces.light[1]).max(surfaces.light[2]);
  strength = (strength * light.colour.maxCoeff() > kNegligible * sofar).select(strength, 0.0F);
  if ((strength <= 0.0F).all()) {
    return;
  }
  if (m_shadows && light.castsShadows) {
    removeShadowed(light, surfaces, strength);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    surfaces.light[k] += strength * light.colour[static_cast<Eigen::Index>(k)];
  }
}

void Shader::removeShadowed(const Light &light, const Surfaces &surfaces, Lanes &strength) const
{
  constexpr float kFar = 1000.0F;
  const bool isSun = light.kind == Light::Kind::Directional;
  alignas(64) std::array<int, kPacket> valid{};
  alignas(64) RTCRay16 rays{};
  for (int i = 0; i < kPacket; ++i) {
    if (strength[i] <= 0.0F) {
      continue;
    }
    valid[static_cast<std::size_t>(i)] = -1;
    const Eigen::Vector3f from(surfaces.position[0][i], surfaces.position[1][i],
                               surfaces.position[2][i]);
    const Eigen::Vector3f way =
        isSun ? Eigen::Vector3f(-kFar * light.direction) : Eigen::Vector3f(light.position - from);
    rays.org_x[i] = from.x();
    rays.org_y[i] = from.y();
    rays.org_z[i] = from.z();
    rays.dir_x[i] = way.x();
    rays.dir_y[i] = way.y();
    rays.dir_z[i] = way.z();
    // The last part is left out, so that the lamp's own body throws no shadow on everything.
    rays.tfar[i] =
        isSun ? 1.0F : std::max(0.0F, 1.0F - kLampBody / std::max(way.norm(), kLampBody));
    rays.mask[i] = ~0U;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcOccluded16(valid.data(), m_building.embree.scene(), &context, &rays);
  if (m_things) {
    for (int i = 0; i < kPacket; ++i) {
      valid[static_cast<std::size_t>(i)] = strength[i] > 0.0F && rays.tfar[i] >= 0.0F ? -1 : 0;
    }
    rtcOccluded16(valid.data(), m_things->embree.scene(), &context, &rays);
  }
  for (int i = 0; i < kPacket; ++i) {
    if (strength[i] > 0.0F && rays.tfar[i] < 0.0F) {
      strength[i] = 0.0F;
    }
  }
}

} // namespace homeward
