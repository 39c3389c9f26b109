// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/panorama.h>
#include <homeward/core/pose2.h>
#include <homeward/core/scan.h>
#include <homeward/laser/open_directions.h>
#include <homeward/topology/map.h>

#include <opencv2/core/mat.hpp>

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace homeward
{

/** How fast the robot was to drive, and drove. */
struct SpeedSample
{
  double seconds = 0.0; ///< since the mission began
  Twist2 told;          ///< what the base was told
  Twist2 measured;      ///< what it says it does
  double sure = 0.0;    ///< confidence of the newest home vector; 0 without one
};

/** A mission at one moment, as far as it is known by then. */
struct MissionScene
{
  double seconds = 0.0;                         ///< since the mission began, robot time
  std::string state;                            ///< what the robot does
  std::string reason;                           ///< what it decided last, and by what
  Panorama view;                                ///< CV_8UC1 or CV_8UC3; empty: none yet
  std::string goal;                             ///< the place that it drives home to
  double sure = 0.0;                            ///< confidence of the way home, 0 to 1
  std::optional<double> battery;                ///< volts
  double viewAge = 0.0;                         ///< seconds since the view was taken
  double scanAge = 0.0;                         ///< seconds since the scan was taken
  std::optional<double> home;                   ///< bearing of the goal in the view, radians
  std::vector<std::pair<NodeId, double>> alike; ///< what the view may show, with probabilities
  std::optional<Scan> scan;                     ///< laser frame
  std::vector<OpenDirection> openDirections;    ///< of the scan
  std::shared_ptr<const TopologicalMap> map;    ///< null: none yet
  std::map<NodeId, Pose2> poses;                ///< true, world frame; empty: nobody knows them
  std::optional<Pose2> robot;                   ///< true, world frame
  std::vector<NodeId> route;                    ///< nodes on its way, the one it left first
  std::deque<SpeedSample> speeds;               ///< newest last
};

/** The view with the way home as an arrow, and the places that it may show. Width at least 400. */
cv::Mat sightImage(const MissionScene &scene, int width);

/** Speeds and turn rates of the last half minute. At least 200 pixels each way. */
cv::Mat speedImage(const MissionScene &scene, int width, int height);

/** A picture and what stands above its window. */
struct TitledImage
{
  std::string title; ///< a few words
  cv::Mat image;     ///< CV_8UC3 BGR
};

/** View, scan, map and speeds, each a picture of a size that does not change, CV_8UC3 BGR. */
std::vector<TitledImage> missionImages(const MissionScene &scene);

/** Size of missionImage(), pixels. */
inline constexpr int kMissionWidth = 1280;
inline constexpr int kMissionHeight = 840; ///< pixels

/** All of missionImages() in one, with the state in words below. */
cv::Mat missionImage(const MissionScene &scene);

} // namespace homeward
