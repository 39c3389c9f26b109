// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.h"
#include "files.h"
#include "robot_file.h"

#include <homeward/calib/bearing_tracks.h>
#include <homeward/core/angle.h>
#include <homeward/dataset/data_set.h>

#include <nlohmann/json.hpp>

#include <chrono>
#include <cmath>
#include <memory>

namespace homeward
{
namespace
{

struct MountCommandOptions
{
  std::string drive;
  std::string robot;
  std::string output;
  std::string json;
};

MountEstimate estimateFrom(const DataSet &set)
{
  std::vector<DriveView> drive;
  for (std::size_t i = 0; i < set.size(); ++i) {
    drive.push_back({set.view(i).pose, set.panorama(i)});
  }
  return calibrateMount(trackBearings(drive, set.visible()));
}

nlohmann::json summaryOf(const MountEstimate &mount, std::size_t views)
{
  nlohmann::json json = jsonHeader("mount");
  json["seed"] = 0;
  const auto sigma = [&](int i) { return std::sqrt(mount.covariance(i, i)); };
  json["parameters"]["x_m"] = {{"value", mount.rMp.x}, {"sigma", sigma(0)}};
  json["parameters"]["y_m"] = {{"value", mount.rMp.y}, {"sigma", sigma(1)}};
  json["parameters"]["yaw_deg"] = {{"value", degrees(mount.rMp.heading)},
                                   {"sigma", degrees(sigma(2))}};
  json["rms_deg"] = degrees(mount.rms);
  json["landmarks"] = mount.landmarks;
  json["views"] = views;
  return json;
}

void calibrateMountFrom(const MountCommandOptions &options)
{
  const auto begin = std::chrono::steady_clock::now();
  const DataSet set = DataSet::read(options.drive);
  const std::string robot = readText(options.robot, "robot file");
  const MountEstimate mount = estimateFrom(set);
  writeText(options.output, withMirrorAt(robot, options.robot, mount.rMp));
  nlohmann::json json = summaryOf(mount, set.size());
  json["robot"] = options.output;
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  json["wall_time_s"] = spent.count();
  writeJson(options.json, json);
  const auto sigma = [&](int i) { return std::sqrt(mount.covariance(i, i)); };
  std::printf("camera at x %.3f m (+- %.3f), y %.3f m (+- %.3f), yaw %.2f degrees (+- %.2f), by "
              "%d landmarks in %zu pictures; wrote %s\n",
              mount.rMp.x, sigma(0), mount.rMp.y, sigma(1), degrees(mount.rMp.heading),
              degrees(sigma(2)), mount.landmarks, set.size(), options.output.c_str());
}

} // namespace

void addMountCommand(CliCommand app)
{
  auto options = std::make_shared<MountCommandOptions>();
  CliCommand command = app.command(
      "mount", "Where the camera sits on the robot, from a turn on the spot and a straight line");
  command.examples("Example: homeward-calibrate mount drive/ --robot pioneer3at.urdf -o mine.urdf");
  command
      .option("drive", options->drive,
              "Data set folder of a short drive: camera.yaml, pictures, and poses.csv with "
              "the robot's odometry")
      .required();
  command.option("--robot", options->robot, "URDF of the robot that the rig names").required();
  command.output("-o,--output", options->output, "URDF to write, with the mirror in its place")
      .required();
  command.json(options->json, "a summary");
  command.run([options] {
    calibrateMountFrom(*options);
    return kExitDone;
  });
}

} // namespace homeward
