// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/evaluation/rendered_homing.h>

#include <map>
#include <utility>

namespace homeward
{

namespace
{

/** Homes that are drawn; more than any task needs, but for worlds that are too small for it. */
constexpr std::size_t kMostHomes = 400;

/** Homes are drawn from another seed than the grid. */
constexpr std::uint64_t kHomeSeed = 0x9e3779b97f4a7c15ULL;

/** Numbers what is used in the order of its first use. */
class Renumbering
{
public:
  std::size_t operator()(std::size_t old, const std::vector<Pose2> &poses)
  {
    const auto [entry, added] = m_numbers.try_emplace(old, m_poses.size());
    if (added) {
      m_poses.push_back(poses[old]);
    }
    return entry->second;
  }

  const std::vector<Pose2> &poses() const { return m_poses; }

private:
  std::map<std::size_t, std::size_t> m_numbers;
  std::vector<Pose2> m_poses;
};

} // namespace

HomingTask renderedHomingTask(const ViewSource &source, const FreeSpace &space,
                              const RenderedHomingOptions &options, const Progress &progress)
{
  const std::vector<Pose2> grid = gridPoses(space, options.spacing, options.seed);
  const std::vector<Pose2> places = randomPoses(space, kMostHomes, options.seed ^ kHomeSeed);
  const Sees sees = [&](const Eigen::Vector2d &a, const Eigen::Vector2d &b) {
    return space.sees(a, b);
  };
  Renumbering views;
  Renumbering homes;
  HomingTask task;
  for (const HomingPair &pair : chooseHomingPairs(grid, places, sees, options.pairs)) {
    task.pairs.push_back({views(pair.view, grid), homes(pair.home, places)});
  }
  task.viewPoses = views.poses();
  task.homePoses = homes.poses();
  const std::size_t all = task.viewPoses.size() + task.homePoses.size();
  ViewSource camera = source;
  const auto render = [&](const std::vector<Pose2> &poses, LightPreset light, std::size_t before) {
    ++camera.noiseStream;
    auto set = std::make_shared<DataSet>(source.camera);
    addRenderedViews(*set, camera, poses, light, [&](std::size_t done, std::size_t) {
      if (progress) {
        progress(before + done, all);
      }
    });
    set->followRim();
    return [set = std::shared_ptr<const DataSet>(std::move(set))](std::size_t i) {
      return set->panorama(i);
    };
  };
  task.viewPanorama = render(task.viewPoses, options.nowLight, 0);
  task.homePanorama = render(task.homePoses, options.mapLight, task.viewPoses.size());
  return task;
}

} // namespace homeward
