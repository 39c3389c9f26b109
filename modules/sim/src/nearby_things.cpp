// SPDX-License-Identifier: GPL-3.0-or-later
#include "nearby_things.h"

#include <algorithm>
#include <iterator>

namespace homeward
{

namespace
{

constexpr double kBody = 1.0;  // metres that no body reaches from its middle
constexpr double kMoved = 1.0; // metres after which the map is drawn anew

} // namespace

void NearbyThings::put(std::shared_ptr<const Scene> things)
{
  m_things = std::move(things);
  m_middle.reset();
}

std::shared_ptr<const CollisionMap> NearbyThings::around(const Pose2 &wMr)
{
  if (!m_things) {
    return nullptr;
  }
  if (m_middle && (*m_middle - wMr.translation()).norm() < kMoved) {
    return m_map;
  }
  m_middle = wMr.translation();
  Scene near;
  std::copy_if(m_things->collisions.begin(), m_things->collisions.end(),
               std::back_inserter(near.collisions), [&](const Mesh &mesh) {
                 const Eigen::AlignedBox3f box = boundsOf({mesh});
                 const Eigen::Vector3f at(static_cast<float>(wMr.x), static_cast<float>(wMr.y),
                                          box.center().z());
                 return box.exteriorDistance(at) < kBody + kMoved;
               });
  m_map = nullptr;
  if (!near.collisions.empty()) {
    const RayCaster caster(std::make_shared<const Scene>(std::move(near)),
                           RayCaster::Layer::Collision);
    m_map = std::make_shared<const CollisionMap>(caster, m_robot);
  }
  return m_map;
}

} // namespace homeward
