// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ray_caster_embree.h"

#include <homeward/sim/light_preset.h>
#include <homeward/sim/scene.h>

#include <Eigen/Core>

#include <array>
#include <memory>
#include <vector>

namespace homeward
{

/** Rays in one packet, as many as Embree takes at once. */
inline constexpr int kPacket = 16;

/** Sixteen neighbouring rays from one point. */
struct RayPacket
{
  std::array<Eigen::Vector3f, kPacket> directions; ///< unit, world frame
  std::array<float, kPacket> spread;               ///< angle between neighbouring rays, radians
  int count = 0;                                   ///< rays in use
};

/** A number for each ray of a packet. */
using Lanes = Eigen::Array<float, kPacket, 1>;

/** Linear RGB that comes along each ray of a packet. */
using RadiancePacket = std::array<Eigen::Vector3f, kPacket>;

/**
 * Says what light comes along a ray: Lambert's law on both sides of every surface, lamps with
 * shadows, and an ambient light that differs between up and down. No interreflection.
 *
 * A pure function of scene and lighting; several threads may ask.
 */
class Shader
{
public:
  Shader(std::shared_ptr<const Scene> scene, const Lighting &lighting, bool shadows);

  /**
   * Things that are seen besides, instead of those put before.
   * @param things their lights do not count; null: nothing
   */
  void put(std::shared_ptr<const Scene> things);

  RadiancePacket radiance(const Eigen::Vector3f &origin, const RayPacket &rays) const;

private:
  struct Surfaces;

  /** A scene's surfaces; the ids of the search tree's meshes begin at `firstId`. */
  struct Layer
  {
    Layer(std::shared_ptr<const Scene> visible, unsigned first);

    std::shared_ptr<const Scene> scene;
    unsigned firstId;
    EmbreeScene embree;
    std::vector<std::vector<float>> texelDensity; ///< by mesh and triangle, texels a metre
  };

  void readSurface(const RTCRayHit16 &hits, int lane, const Eigen::Vector3f &origin,
                   const RayPacket &rays, Surfaces &surfaces) const;
  void addLight(const Light &light, Surfaces &surfaces) const;
  void removeShadowed(const Light &light, const Surfaces &surfaces, Lanes &strength) const;

  Layer m_building;
  std::unique_ptr<const Layer> m_things; ///< null when there are none
  Lighting m_lighting;
  bool m_shadows;
};

} // namespace homeward
