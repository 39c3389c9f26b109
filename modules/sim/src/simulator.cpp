// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/sim/simulator.h>

#include "lift.h"
#include "nearby_things.h"
#include "random_streams.h"

#include <homeward/core/error.h>
#include <homeward/sim/sonar_model.h>

#include <array>
#include <cstdio>
#include <string>
#include <utility>

namespace homeward
{

namespace
{

constexpr double kLeastArea = 1.0; // square metres

std::string describe(const Pose2 &pose)
{
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), "start %.2f,%.2f,%.2f", pose.x, pose.y, pose.heading);
  return text.data();
}

/** @throw ConfigError when a robot cannot be put there */
void checkStart(const CollisionMap &map, const FreeSpace &space, const Pose2 &start)
{
  const Eigen::AlignedBox2d &bounds = map.bounds();
  if (!bounds.contains(start.translation())) {
    std::array<char, 128> text{};
    std::snprintf(text.data(), text.size(), "x %.2f to %.2f, y %.2f to %.2f", bounds.min().x(),
                  bounds.max().x(), bounds.min().y(), bounds.max().y());
    throw ConfigError(describe(start) + " is outside the world (" + text.data() +
                      "): choose one inside, or none");
  }
  if (map.touches(start)) {
    throw ConfigError(describe(start) + " is in a wall or a piece of furniture: choose one on free "
                                        "floor, or none");
  }
  if (space.areaAround(start.translation()) < kLeastArea) {
    throw ConfigError(describe(start) + " leaves the robot less than 1 m^2 to drive in: choose one "
                                        "in a room, or none");
  }
}

/** The world as the robot's body meets it, and where the robot stands in it. */
struct Surroundings
{
  std::shared_ptr<const RayCaster> caster;
  std::shared_ptr<const CollisionMap> map;
  FloorGrid grid;
  Pose2 start;
};

Surroundings surroundings(const std::shared_ptr<const Scene> &scene, const RobotDescription &robot,
                          const SimulatorOptions &options)
{
  const auto caster = std::make_shared<const RayCaster>(scene, RayCaster::Layer::Collision);
  const auto map = std::make_shared<const CollisionMap>(*caster, robot);
  if (map->bounds().isEmpty()) {
    throw ConfigError("nothing stands on the floor of world '" + scene->name +
                      "': its walls and furniture need collision geometry above z = 0");
  }
  const FloorGrid grid(*map);
  return {caster, map, grid, options.start ? *options.start : defaultStart(*map, grid)};
}

/** The moving part, shared by the devices. */
struct World
{
  WheeledBase base;
  std::shared_ptr<const CollisionMap> map;
  NearbyThings things;
  const std::function<void(Time)> &onStep;
  Time now{};

  void step()
  {
    if (onStep) {
      onStep(now);
    }
    base.meet(map, things.around(base.pose()));
    base.step(now, Simulator::kStep);
    now += Simulator::kStep;
  }

  bool touches(const Pose2 &wMr)
  {
    const std::shared_ptr<const CollisionMap> near = things.around(wMr);
    return map->touches(wMr) || (near && near->touches(wMr));
  }
};

class SimulatedClock : public Clock
{
public:
  explicit SimulatedClock(World &world) : m_world(world) {}

  Time now() const override { return m_world.now; }

  void sleepUntil(Time instant) override
  {
    while (m_world.now < instant) {
      m_world.step();
    }
  }

private:
  World &m_world;
};

/** The newest answer of a sensor, measured once an instant. */
template <class T> class Newest
{
public:
  template <class Measure> const T &at(Time now, Measure measure)
  {
    if (!m_value || m_stamp != now) {
      m_value = measure();
      m_stamp = now;
    }
    return *m_value;
  }

  void forget() { m_value.reset(); }

private:
  std::optional<T> m_value;
  Time m_stamp{};
};

class SimulatedBase : public MobileBase
{
public:
  SimulatedBase(World &world, SonarModel sonar) : m_world(world), m_sonar(std::move(sonar)) {}

  void drive(const Twist2 &twist) override { m_world.base.command(m_world.now, twist); }

  BaseState state() override
  {
    const WheeledBase &base = m_world.base;
    const auto &echoes = m_echoes.at(m_world.now, [&] { return m_sonar.measure(base.pose()); });
    return {.stamp = m_world.now,
            .odometry = base.odometry(),
            .velocity = base.velocity(),
            .stalled = base.stalled(),
            .sonar = echoes,
            .halt = {}};
  }

  void setWorld(const SolidWorld &solid)
  {
    m_sonar.setWorld(solid);
    forget();
  }

  void forget() { m_echoes.forget(); }

private:
  World &m_world;
  SonarModel m_sonar;
  Newest<std::vector<SonarEcho>> m_echoes;
};

class SimulatedLaser : public LaserScanner
{
public:
  SimulatedLaser(World &world, LaserModel model) : m_world(world), m_model(std::move(model)) {}

  std::optional<Scan> scan() override
  {
    return m_scan.at(m_world.now,
                     [&] { return m_model.measure(m_world.now, m_world.base.pose()); });
  }

  void setWorld(const SolidWorld &solid)
  {
    m_model.setWorld(solid);
    forget();
  }

  void forget() { m_scan.forget(); }

private:
  World &m_world;
  LaserModel m_model;
  Newest<Scan> m_scan;
};

class SimulatedCamera : public ImageSource
{
public:
  SimulatedCamera(World &world, std::shared_ptr<const Scene> scene, const Eigen::Isometry3d &rMp,
                  const MirrorCamera &nominal, const SimulatorOptions &options)
      : m_world(world), m_scene(std::move(scene)), m_rMp(rMp),
        m_optics(options.exactOptics ? exactOptics(nominal) : drawOptics(nominal, options.seed)),
        m_light(options.light), m_options(options.camera),
        m_noise(options.seed, static_cast<std::uint32_t>(RandomStream::Camera))
  {
    m_options.threads = options.threads;
  }

  std::optional<Frame> grab() override
  {
    const Frame &frame = m_frame.at(m_world.now, [&] { return render(); });
    return Frame{frame.stamp, frame.image.clone()};
  }

  void change(std::shared_ptr<const Scene> scene)
  {
    m_scene = std::move(scene);
    m_renderer.reset();
    forget();
  }

  void put(std::shared_ptr<const Scene> things)
  {
    m_things = std::move(things);
    m_thingsAreNew = true;
    forget();
  }

  void forget() { m_frame.forget(); }

private:
  Frame render()
  {
    // Only who asks for a picture pays for the search tree over everything visible.
    if (!m_renderer) {
      m_renderer.emplace(m_scene, lightingFor(m_light, *m_scene), m_optics, m_options);
      m_thingsAreNew = true;
    }
    if (m_thingsAreNew) {
      m_renderer->put(m_things);
      m_thingsAreNew = false;
    }
    return {m_world.now, m_renderer->render(lift(m_world.base.pose()) * m_rMp, m_noise)};
  }

  World &m_world;
  std::shared_ptr<const Scene> m_scene;
  std::shared_ptr<const Scene> m_things; ///< null when there are none
  bool m_thingsAreNew = false;           ///< to the renderer
  Eigen::Isometry3d m_rMp;
  TrueOptics m_optics;
  LightPreset m_light;
  RenderOptions m_options;
  Random m_noise;
  std::optional<MirrorRenderer> m_renderer;
  Newest<Frame> m_frame;
};

} // namespace

class Simulator::Impl
{
public:
  Impl(const std::shared_ptr<const Scene> &scene, const Surroundings &around,
       const RobotDescription &robot, const MirrorCamera &nominal, const SimulatorOptions &options,
       const std::function<void(Time)> &onStep)
      : description(robot), solid{around.caster},
        space(around.map, around.grid, around.caster, robot.rMp.translation().z(),
              around.start.translation()),
        world{WheeledBase(around.map, options.limits, options.drive, options.seed, around.start),
              around.map, NearbyThings(robot), onStep},
        clock(world), base(world, SonarModel(solid, robot, options.seed)),
        laser(world, LaserModel(solid, robot.rMl, options.laser, options.seed)),
        camera(world, scene, robot.rMp, nominal, options)
  {
    checkStart(*world.map, space, around.start);
  }

  /** Laser and sonar meet what `solid` has become. */
  void sense()
  {
    base.setWorld(solid);
    laser.setWorld(solid);
  }

  RobotDescription description;
  SolidWorld solid;
  FreeSpace space;
  World world;
  SimulatedClock clock;
  SimulatedBase base;
  SimulatedLaser laser;
  SimulatedCamera camera;
};

Simulator::Simulator(const std::shared_ptr<const Scene> &scene, const RobotDescription &robot,
                     const MirrorCamera &nominal, const SimulatorOptions &options)
    : m_impl(std::make_unique<Impl>(scene, surroundings(scene, robot, options), robot, nominal,
                                    options, onStep))
{}

Simulator::~Simulator() = default;

Clock &Simulator::clock()
{
  return m_impl->clock;
}

MobileBase &Simulator::base()
{
  return m_impl->base;
}

LaserScanner &Simulator::laser()
{
  return m_impl->laser;
}

ImageSource &Simulator::camera()
{
  return m_impl->camera;
}

Truth Simulator::truth() const
{
  const WheeledBase &base = m_impl->world.base;
  return {base.pose(), base.distance(), base.contacts().collisions(),
          base.contacts().unseenContacts()};
}

const FreeSpace &Simulator::freeSpace() const
{
  return m_impl->space;
}

void Simulator::kidnap(const Pose2 &wMr)
{
  World &world = m_impl->world;
  checkStart(*world.map, m_impl->space, wMr);
  if (world.touches(wMr)) {
    throw ConfigError(describe(wMr) + " is where somebody or something stands now: choose another");
  }
  world.base.place(wMr);
  m_impl->base.forget();
  m_impl->laser.forget();
  m_impl->camera.forget();
}

void Simulator::change(const std::shared_ptr<const Scene> &scene)
{
  World &world = m_impl->world;
  const auto caster = std::make_shared<const RayCaster>(scene, RayCaster::Layer::Collision);
  const auto map = std::make_shared<const CollisionMap>(*caster, m_impl->description);
  if (map->touches(world.base.pose())) {
    throw ConfigError("the robot stands where the changed world '" + scene->name +
                      "' has something: keep that place free");
  }
  world.map = map;
  m_impl->solid.building = caster;
  m_impl->sense();
  m_impl->camera.change(scene);
}

void Simulator::put(const std::shared_ptr<const Scene> &things)
{
  World &world = m_impl->world;
  NearbyThings near(m_impl->description);
  near.put(things);
  const std::shared_ptr<const CollisionMap> met = near.around(world.base.pose());
  if (met && met->touches(world.base.pose())) {
    throw ConfigError("a thing is put where the robot stands: keep that place free");
  }
  world.things = std::move(near);
  m_impl->solid.things =
      things ? std::make_shared<const RayCaster>(things, RayCaster::Layer::Collision) : nullptr;
  m_impl->sense();
  m_impl->camera.put(things);
}

} // namespace homeward
