// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/sim/light_preset.h>

#include <homeward/core/error.h>
#include <homeward/sim/ray_caster.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace homeward
{

namespace
{

constexpr std::array kNames = {std::pair{std::string_view("day"), LightPreset::Day},
                               std::pair{std::string_view("twilight"), LightPreset::Twilight},
                               std::pair{std::string_view("night"), LightPreset::Night},
                               std::pair{std::string_view("two_lamps"), LightPreset::TwoLamps}};

constexpr float kSpacing = 6.0F;    ///< of added lamps, metres
constexpr int kMostLamps = 24;      ///< the grid widens rather than have more
constexpr float kFloorSpace = 1.5F; ///< a lamp needs this much free height below, metres
constexpr float kHang = 0.25F;      ///< a lamp hangs this far below its ceiling, metres
constexpr float kTallest = 4.5F;    ///< no added lamp hangs higher, metres
constexpr float kRoomHeight = 2.4F; ///< of lamps where there is no ceiling, metres

Light lamp(const Eigen::Vector3f &position)
{
  Light light;
  light.position = position;
  light.colour = {0.95F, 0.92F, 0.85F};
  light.range = 14.0F;
  light.constant = 0.4F;
  light.linear = 0.05F;
  light.quadratic = 0.12F;
  return light;
}

/** The same lamp with another strength and tint. */
Light tinted(Light light, float strength, const Eigen::Vector3f &tint)
{
  light.colour = light.colour.cwiseProduct(tint) * strength;
  return light;
}

/** The whole scene, its infinite planes aside; a small room where there is nothing at all. */
Eigen::AlignedBox3f roomOf(const Scene &scene)
{
  Eigen::AlignedBox3f room = boundsOf(scene.visuals);
  room.extend(boundsOf(scene.collisions));
  if (room.isEmpty()) {
    room = {Eigen::Vector3f(-2.0F, -2.0F, 0.0F), Eigen::Vector3f(2.0F, 2.0F, 2.0F)};
  }
  return room;
}

/** Where a lamp may hang over (x, y), if there is room for one. */
std::optional<Eigen::Vector3f> hangingPlace(const RayCaster &caster,
                                            const Eigen::AlignedBox3f &room, float x, float y)
{
  const float floor = std::max(room.min().z(), -0.5F);
  const Eigen::Vector3f eye(x, y, floor + kFloorSpace);
  const float up = caster.range(eye, Eigen::Vector3f::UnitZ(), 50.0F);
  const float down = caster.range(eye, -Eigen::Vector3f::UnitZ(), 50.0F);
  if (down < 0.5F || up < 2.0F * kHang) {
    return std::nullopt;
  }
  const float ceiling = std::isfinite(up) ? eye.z() + up - kHang : floor + kRoomHeight;
  return Eigen::Vector3f(x, y, std::min(ceiling, floor + kTallest));
}

/** Whether one of the lamps lights the floor below `place` well. */
bool isLit(const RayCaster &caster, const std::vector<Light> &lamps, const Eigen::Vector3f &place)
{
  return std::any_of(lamps.begin(), lamps.end(), [&](const Light &light) {
    const Eigen::Vector3f below(place.x(), place.y(), std::min(place.z(), 1.2F));
    return light.kind == Light::Kind::Point && light.range > kSpacing &&
           (light.position - below).norm() < 0.75F * kSpacing &&
           !caster.blocked(below, light.position);
  });
}

/** The scene's own lights, and lamps wherever they leave a gap. */
std::vector<Light> allLamps(const Scene &scene)
{
  std::vector<Light> lamps = scene.lights;
  for (Light &light : lamps) {
    light.castsShadows = true; // lamps that shine through walls would tell rooms from each other
  }
  // The caster only looks on while the caller's scene is alive.
  const RayCaster caster(std::shared_ptr<const Scene>(&scene, [](const Scene *) {}),
                         RayCaster::Layer::Visual);
  const Eigen::AlignedBox3f room = roomOf(scene);
  const Eigen::Vector3f size = room.sizes();
  const float spacing =
      std::max(kSpacing, std::sqrt(size.x() * size.y() / static_cast<float>(kMostLamps)));
  const int columns = std::max(1, static_cast<int>(std::lround(size.x() / spacing)));
  const int rows = std::max(1, static_cast<int>(std::lround(size.y() / spacing)));
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const float x = room.min().x() +
                      size.x() * (static_cast<float>(column) + 0.5F) / static_cast<float>(columns);
      const float y =
          room.min().y() + size.y() * (static_cast<float>(row) + 0.5F) / static_cast<float>(rows);
      const std::optional<Eigen::Vector3f> place = hangingPlace(caster, room, x, y);
      if (place && !isLit(caster, lamps, *place)) {
        lamps.push_back(lamp(*place));
      }
    }
  }
  return lamps;
}

/** Every `step`-th light that is not the sun, from `first` on. */
std::vector<Light> someOf(const std::vector<Light> &lamps, std::size_t first, std::size_t step,
                          float strength, const Eigen::Vector3f &tint)
{
  std::vector<Light> some;
  std::size_t count = 0;
  for (const Light &light : lamps) {
    if (light.kind != Light::Kind::Directional && count++ % step == first) {
      some.push_back(tinted(light, strength, tint));
    }
  }
  return some.empty() && first > 0 ? someOf(lamps, 0, step, strength, tint) : some;
}

/** Two strong lamps far apart on the longer side of the scene, away from the day's lamps. */
std::vector<Light> twoLamps(const Scene &scene)
{
  const Eigen::AlignedBox3f room = roomOf(scene);
  const Eigen::Vector3f size = room.sizes();
  const bool alongX = size.x() >= size.y();
  std::vector<Light> lamps;
  for (const float share : {0.22F, 0.78F}) {
    const Eigen::Vector2f place = alongX ? Eigen::Vector2f(share, 0.9F - 0.8F * share)
                                         : Eigen::Vector2f(0.9F - 0.8F * share, share);
    Light light =
        lamp({room.min().x() + size.x() * place.x(), room.min().y() + size.y() * place.y(),
              std::max(room.min().z(), 0.0F) + 1.9F});
    light.colour *= 4.0F;
    light.range = 60.0F;
    light.quadratic = 0.08F;
    lamps.push_back(light);
  }
  return lamps;
}

} // namespace

LightPreset parseLightPreset(std::string_view name)
{
  for (const auto &[known, preset] : kNames) {
    if (known == name) {
      return preset;
    }
  }
  throw ConfigError("light '" + std::string(name) +
                    "' is not known; choose day, twilight, night or two_lamps");
}

std::string_view name(LightPreset preset)
{
  for (const auto &[known, value] : kNames) {
    if (value == preset) {
      return known;
    }
  }
  throw LogicError("light preset " + std::to_string(static_cast<int>(preset)) + " has no name");
}

Lighting lightingFor(LightPreset preset, const Scene &scene)
{
  Lighting lighting;
  lighting.background = scene.background;
  switch (preset) {
  case LightPreset::Day:
    lighting.lights = allLamps(scene);
    lighting.sky = {0.42F, 0.43F, 0.45F};
    lighting.ground = {0.24F, 0.23F, 0.22F};
    break;
  case LightPreset::Twilight:
    lighting.lights = someOf(allLamps(scene), 0, 2, 0.35F, {1.0F, 0.85F, 0.65F});
    lighting.sky = {0.055F, 0.075F, 0.12F};
    lighting.ground = {0.022F, 0.028F, 0.04F};
    lighting.background *= 0.12F;
    lighting.exposureMax = 1.2F;
    break;
  case LightPreset::Night:
    lighting.lights = someOf(allLamps(scene), 1, 3, 0.12F, {1.0F, 0.68F, 0.38F});
    lighting.sky = {0.012F, 0.013F, 0.017F};
    lighting.ground = {0.006F, 0.006F, 0.007F};
    lighting.background = {0.004F, 0.005F, 0.009F};
    lighting.exposureMax = 2.2F;
    break;
  case LightPreset::TwoLamps:
    lighting.lights = twoLamps(scene);
    lighting.sky = {0.05F, 0.05F, 0.05F};
    lighting.ground = {0.04F, 0.04F, 0.04F};
    lighting.background *= 0.1F;
    lighting.exposureMax = 1.5F;
    break;
  }
  return lighting;
}

} // namespace homeward
