// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/sim/scene.h>

#include <embree3/rtcore.h>

namespace homeward
{

/** Below this opacity rays pass: glass is left out rather than drawn as a wall. */
inline constexpr float kSeeThrough = 0.6F;

/**
 * Embree's search tree over meshes of a scene; geometry `firstId` + i is mesh i, see-through ones
 * have none.
 */
class EmbreeScene
{
public:
  EmbreeScene(const Scene &scene, const std::vector<Mesh> &meshes, unsigned firstId = 0);
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene &) = delete;
  EmbreeScene &operator=(const EmbreeScene &) = delete;

  RTCScene scene() const { return m_scene; }

private:
  RTCDevice m_device;
  RTCScene m_scene;
};

} // namespace homeward
