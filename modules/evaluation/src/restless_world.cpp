// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/evaluation/restless_world.h>

#include "walkers.h"

#include <homeward/core/error.h>
#include <homeward/evaluation/changed_scene.h>

#include <utility>

namespace homeward
{

namespace
{

constexpr std::uint32_t kMoveStream = 407;
constexpr Duration kWalkStep = std::chrono::milliseconds(100);

} // namespace

class RestlessWorld::Impl
{
public:
  Impl(Simulator &simulator, std::shared_ptr<const Scene> scene, const Restlessness &restlessness,
       std::uint64_t seed)
      : m_simulator(simulator), m_scene(std::move(scene)), m_restlessness(restlessness),
        m_random(seed, kMoveStream),
        m_walkers(simulator.freeSpace(), restlessness.people, simulator.truth().pose, seed),
        m_nextWalk(simulator.clock().now()), m_nextMove(m_nextWalk + drawCalm())
  {
    show(nullptr);
    m_simulator.onStep = [this](Time now) { step(now); };
  }

  ~Impl() { m_simulator.onStep = nullptr; }
  Impl(const Impl &) = delete;
  Impl &operator=(const Impl &) = delete;

  void put(const std::shared_ptr<const Scene> &things)
  {
    show(things);
    m_things = things;
  }

  const Walkers &walkers() const { return m_walkers; }
  int moves() const { return m_moves; }

private:
  void step(Time now)
  {
    if (now >= m_nextMove) {
      m_nextMove = now + drawCalm();
      moveFurniture();
    }
    if (now >= m_nextWalk) {
      m_nextWalk = now + kWalkStep;
      m_walkers.walk(now, kWalkStep, m_simulator.truth().pose, inTheWay());
      show(m_things);
    }
  }

  /** Things, and the people where they are. */
  void show(const std::shared_ptr<const Scene> &things)
  {
    auto all = things ? std::make_shared<Scene>(*things) : std::make_shared<Scene>();
    m_walkers.addTo(*all);
    m_simulator.put(all);
  }

  std::vector<Eigen::AlignedBox3f> inTheWay() const
  {
    std::vector<Eigen::AlignedBox3f> boxes = m_moved;
    if (m_things) {
      boxes.push_back(boundsOf(m_things->collisions));
    }
    return boxes;
  }

  void moveFurniture()
  {
    if (m_restlessness.moveFurniture <= 0.0) {
      return;
    }
    std::vector<Pose2> clear{m_simulator.truth().pose};
    for (const Eigen::Vector2d &place : m_walkers.places()) {
      clear.push_back({place.x(), place.y(), 0.0});
    }
    ChangedScene changed =
        changeScene(*m_scene, m_simulator.freeSpace(), clear,
                    {.moveFurniture = m_restlessness.moveFurniture}, m_random.bits());
    if (furnish(std::move(changed.scene))) {
      m_moved = std::move(changed.moved);
      ++m_moves;
    }
  }

  /** @return false, and all stays as it is, where a chair would come back to where the robot stands
   * by now */
  bool furnish(Scene scene)
  {
    try {
      m_simulator.change(std::make_shared<const Scene>(std::move(scene)));
      return true;
    }
    catch (const ConfigError &) {
      return false;
    }
  }

  Duration drawCalm() { return fromSeconds(m_restlessness.calm * m_random.uniform(0.5, 1.5)); }

  Simulator &m_simulator;
  std::shared_ptr<const Scene> m_scene;
  Restlessness m_restlessness;
  Random m_random;
  Walkers m_walkers;
  Time m_nextWalk;
  Time m_nextMove;
  std::vector<Eigen::AlignedBox3f> m_moved; ///< round each chair that is not in its place
  std::shared_ptr<const Scene> m_things;    ///< that somebody has put there; may be null
  int m_moves = 0;
};

RestlessWorld::RestlessWorld(Simulator &simulator, std::shared_ptr<const Scene> scene,
                             const Restlessness &restlessness, std::uint64_t seed)
    : m_impl(std::make_unique<Impl>(simulator, std::move(scene), restlessness, seed))
{}

RestlessWorld::~RestlessWorld() = default;

void RestlessWorld::put(const std::shared_ptr<const Scene> &things)
{
  m_impl->put(things);
}

std::vector<Eigen::Vector2d> RestlessWorld::people() const
{
  return m_impl->walkers().places();
}

int RestlessWorld::moves() const
{
  return m_impl->moves();
}

} // namespace homeward
