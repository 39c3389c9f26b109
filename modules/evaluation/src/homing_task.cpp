// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/evaluation/homing_task.h>

#include <homeward/core/error.h>
#include <homeward/core/random.h>

#include <algorithm>
#include <utility>

namespace homeward
{

namespace
{

constexpr std::uint32_t kOrderStream = 402;

/** Fisher and Yates; std::shuffle is not the same everywhere. */
void shuffle(std::vector<std::size_t> &values, Random &random)
{
  for (std::size_t i = values.size(); i > 1; --i) {
    std::swap(values[i - 1], values[random.bits() % i]);
  }
}

std::vector<std::size_t> viewsOf(const DataSet &set, const std::string &light)
{
  std::vector<std::size_t> found = set.viewsOf(light);
  if (found.empty()) {
    std::string known;
    for (const std::string &other : set.lights()) {
      known += (known.empty() ? "" : ", ") + other;
    }
    throw ConfigError("the data set has no view in light '" + light + "', it has " + known);
  }
  return found;
}

std::vector<Pose2> posesOf(const DataSet &set, const std::vector<std::size_t> &indices)
{
  std::vector<Pose2> poses;
  poses.reserve(indices.size());
  for (const std::size_t index : indices) {
    poses.push_back(set.view(index).pose);
  }
  return poses;
}

} // namespace

std::vector<HomingPair> chooseHomingPairs(const std::vector<Pose2> &views,
                                          const std::vector<Pose2> &homes, const Sees &sees,
                                          const HomingPairOptions &options)
{
  if (!(options.nearest > 0.0) || !(options.farthest > options.nearest)) {
    throw LogicError("homing pairs are " + std::to_string(options.nearest) + " to " +
                     std::to_string(options.farthest) + " m apart, must be 0 < nearest < farthest");
  }
  std::vector<HomingPair> pairs;
  for (std::size_t h = 0; h < homes.size() && pairs.size() < options.pairs; ++h) {
    const Eigen::Vector2d home = homes[h].translation();
    std::vector<HomingPair> ofHome;
    for (std::size_t v = 0; v < views.size(); ++v) {
      const Eigen::Vector2d view = views[v].translation();
      const double distance = (view - home).norm();
      if (distance >= options.nearest && distance <= options.farthest && sees(view, home)) {
        ofHome.push_back({v, h});
      }
    }
    if (ofHome.size() >= options.fewest) {
      pairs.insert(pairs.end(), ofHome.begin(), ofHome.end());
    }
  }
  return pairs;
}

double HomingTask::trueDirection(const HomingPair &pair) const
{
  const Pose2 &view = viewPoses.at(pair.view);
  const Eigen::Vector2d home = view.inverse() * homePoses.at(pair.home).translation();
  return std::atan2(home.y(), home.x());
}

double HomingTask::trueHeadingChange(const HomingPair &pair) const
{
  return wrapAngle(viewPoses.at(pair.view).heading - homePoses.at(pair.home).heading);
}

HomingTask homingTask(const DataSet &set, const std::string &mapLight, const std::string &nowLight,
                      const Sees &sees, std::uint64_t seed, const HomingPairOptions &options)
{
  std::vector<std::size_t> homes = viewsOf(set, mapLight);
  const std::vector<std::size_t> views = viewsOf(set, nowLight);
  Random random(seed, kOrderStream);
  shuffle(homes, random);
  HomingTask task;
  task.viewPoses = posesOf(set, views);
  task.homePoses = posesOf(set, homes);
  task.viewPanorama = [&set, views](std::size_t i) { return set.panorama(views.at(i)); };
  task.homePanorama = [&set, homes](std::size_t i) { return set.panorama(homes.at(i)); };
  task.pairs = chooseHomingPairs(task.viewPoses, task.homePoses, sees, options);
  return task;
}

} // namespace homeward
