// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/sim/scene.h>

#include <embree3/rtcore.h>

namespace homeward
{

/** Embree's search tree over meshes; geometry i is mesh i. */
class EmbreeScene
{
public:
  explicit EmbreeScene(const std::vector<Mesh> &meshes);
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene &) = delete;
  EmbreeScene &operator=(const EmbreeScene &) = delete;

  RTCScene scene() const { return m_scene; }

private:
  RTCDevice m_device;
  RTCScene m_scene;
};

} // namespace homeward
