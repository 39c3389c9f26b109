// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/sim/ray_caster.h>

#include "ray_caster_embree.h"

#include <homeward/core/error.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace homeward
{

namespace
{

void attach(RTCDevice device, RTCScene scene, const Mesh &mesh, unsigned index)
{
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto *vertices = static_cast<float *>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                              3 * sizeof(float), mesh.vertices.size()));
  auto *indices = static_cast<unsigned *>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(unsigned), mesh.triangles.size()));
  if (vertices != nullptr && indices != nullptr) {
    for (const Eigen::Vector3f &vertex : mesh.vertices) {
      vertices = std::copy_n(vertex.data(), 3, vertices);
    }
    for (const Eigen::Vector3i &triangle : mesh.triangles) {
      for (int corner = 0; corner < 3; ++corner) {
        *indices++ = static_cast<unsigned>(triangle[corner]);
      }
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, index);
  }
  rtcReleaseGeometry(geometry);
}

bool isSeeThrough(const Scene &scene, const Mesh &mesh)
{
  return mesh.material >= 0 &&
         scene.materials[static_cast<std::size_t>(mesh.material)].opacity < kSeeThrough;
}

RTCRay makeRay(const Eigen::Vector3f &origin, const Eigen::Vector3f &direction, float near,
               float far)
{
  RTCRay ray{};
  ray.org_x = origin.x();
  ray.org_y = origin.y();
  ray.org_z = origin.z();
  ray.tnear = near;
  ray.dir_x = direction.x();
  ray.dir_y = direction.y();
  ray.dir_z = direction.z();
  ray.tfar = far;
  ray.mask = ~0U;
  return ray;
}

} // namespace

EmbreeScene::EmbreeScene(const Scene &scene, const std::vector<Mesh> &meshes, unsigned firstId)
    // One building thread: the tree, and so the answer to a tie, is the same on every machine.
    : m_device(rtcNewDevice("threads=1")), m_scene(nullptr)
{
  if (m_device == nullptr) {
    throw RuntimeError("cannot start Embree, the ray casting library: error " +
                       std::to_string(static_cast<int>(rtcGetDeviceError(nullptr))));
  }
  m_scene = rtcNewScene(m_device);
  rtcSetSceneFlags(m_scene, RTC_SCENE_FLAG_ROBUST);
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    if (!meshes[i].triangles.empty() && !isSeeThrough(scene, meshes[i])) {
      attach(m_device, m_scene, meshes[i], firstId + static_cast<unsigned>(i));
    }
  }
  rtcCommitScene(m_scene);
}

EmbreeScene::~EmbreeScene()
{
  rtcReleaseScene(m_scene);
  rtcReleaseDevice(m_device);
}

RayCaster::RayCaster(std::shared_ptr<const Scene> scene, Layer layer)
    : m_scene(std::move(scene)), m_layer(layer),
      m_embree(std::make_unique<EmbreeScene>(*m_scene, meshes()))
{}

RayCaster::~RayCaster() = default;
RayCaster::RayCaster(RayCaster &&) noexcept = default;
RayCaster &RayCaster::operator=(RayCaster &&) noexcept = default;

const std::vector<Mesh> &RayCaster::meshes() const
{
  return m_layer == Layer::Visual ? m_scene->visuals : m_scene->collisions;
}

float RayCaster::range(const Eigen::Vector3f &origin, const Eigen::Vector3f &direction,
                       float maxRange) const
{
  const std::optional<RayHit> met = hit(origin, direction, maxRange);
  return met ? met->range : std::numeric_limits<float>::infinity();
}

std::optional<RayHit> RayCaster::hit(const Eigen::Vector3f &origin,
                                     const Eigen::Vector3f &direction, float maxRange) const
{
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  const Eigen::Vector3f unit = direction.normalized();
  RTCRayHit query{};
  query.ray = makeRay(origin, unit, 0.0F, maxRange);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(m_embree->scene(), &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
    return std::nullopt;
  }
  Eigen::Vector3f normal(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z);
  normal.normalize();
  if (normal.dot(unit) > 0.0F) {
    normal = -normal;
  }
  return RayHit{query.ray.tfar,
                static_cast<int>(query.hit.geomID),
                static_cast<int>(query.hit.primID),
                {query.hit.u, query.hit.v},
                normal};
}

bool RayCaster::blocked(const Eigen::Vector3f &from, const Eigen::Vector3f &to) const
{
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray = makeRay(from, to - from, 0.0F, 1.0F);
  rtcOccluded1(m_embree->scene(), &context, &ray);
  return ray.tfar < 0.0F;
}

} // namespace homeward
