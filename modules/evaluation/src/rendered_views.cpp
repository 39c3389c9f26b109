// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/evaluation/rendered_views.h>

#include <homeward/core/error.h>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

namespace homeward
{

namespace
{

/** Streams of random numbers, apart from those of the simulator. */
constexpr std::uint32_t kPoseStream = 401;
constexpr std::uint32_t kNoiseStream = 10'000; ///< the first; a million apart for each source's

Eigen::Isometry3d liftPose(const Pose2 &wMr)
{
  Eigen::Isometry3d spatial = Eigen::Isometry3d::Identity();
  spatial.translate(Eigen::Vector3d(wMr.x, wMr.y, 0.0));
  spatial.rotate(Eigen::AngleAxisd(wMr.heading, Eigen::Vector3d::UnitZ()));
  return spatial;
}

std::string fileName(LightPreset light, std::size_t number)
{
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%s_%05zu.png", std::string(name(light)).c_str(), number);
  return text.data();
}

} // namespace

std::vector<Pose2> gridPoses(const FreeSpace &space, double spacing, std::uint64_t seed)
{
  if (!(spacing > 0.0)) {
    throw LogicError("grid spacing is " + std::to_string(spacing) + " m, must be positive");
  }
  Random random(seed, kPoseStream);
  const FloorRaster &raster = space.grid().raster();
  const Eigen::Vector2d size = raster.resolution * Eigen::Vector2d(raster.columns, raster.rows);
  const Eigen::Vector2d offset{random.uniform(0.0, spacing), random.uniform(0.0, spacing)};
  std::vector<Pose2> poses;
  for (int row = 0; offset.y() + row * spacing < size.y(); ++row) {
    for (int column = 0; offset.x() + column * spacing < size.x(); ++column) {
      const Eigen::Vector2d point = raster.origin + offset + spacing * Eigen::Vector2d(column, row);
      if (space.reachable(point)) {
        poses.push_back({point.x(), point.y(), random.uniform(-kPi, kPi)});
      }
    }
  }
  return poses;
}

std::vector<Pose2> randomPoses(const FreeSpace &space, std::size_t count, std::uint64_t seed)
{
  const std::vector<Eigen::Vector2d> &cells = space.reachableCells();
  if (cells.empty()) {
    throw LogicError("no floor of this world can be reached");
  }
  Random random(seed, kPoseStream);
  const double half = space.grid().raster().resolution / 2.0;
  std::vector<Pose2> poses;
  for (std::size_t i = 0; i < count; ++i) {
    const double share = random.uniform(0.0, static_cast<double>(cells.size()));
    const Eigen::Vector2d cell = cells[std::min(cells.size() - 1, static_cast<std::size_t>(share))];
    const double x = cell.x() + random.uniform(-half, half);
    const double y = cell.y() + random.uniform(-half, half);
    poses.push_back({x, y, random.uniform(-kPi, kPi)});
  }
  return poses;
}

void addRenderedViews(DataSet &set, const ViewSource &source, const std::vector<Pose2> &poses,
                      LightPreset light, const Progress &progress)
{
  const TrueOptics optics =
      source.exactOptics ? exactOptics(source.camera) : drawOptics(source.camera, source.seed);
  MirrorRenderer renderer(source.scene, lightingFor(light, *source.scene), optics,
                          source.rendering);
  Random noise(source.seed, kNoiseStream + 1'000'000 * source.noiseStream +
                                static_cast<std::uint32_t>(set.size()));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    cv::Mat picture = renderer.render(liftPose(poses[i]) * source.rMp, noise);
    if (!source.colour) {
      cv::Mat gray;
      cv::cvtColor(picture, gray, cv::COLOR_BGR2GRAY);
      picture = gray;
    }
    set.add({fileName(light, set.size()), poses[i], std::string(name(light))}, picture);
    if (progress) {
      progress(i + 1, poses.size());
    }
  }
}

} // namespace homeward
