// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "robot_files.h"

#include <homeward/run/navigation.h>

#include <optional>
#include <string>
#include <vector>

namespace homeward
{

/** A goal as the command line has it. */
struct GoalWord
{
  std::string word; ///< the number or name of a node, or a picture file
  cv::Mat picture;  ///< empty when the word is a node
};

/** A place to drive to. */
struct NavigationGoal
{
  std::string word;
  NodeId node;                     ///< of Navigation::map()
  std::optional<PlaceMatch> shown; ///< of a picture: the place that it shows
};

/**
 * The goals of a list such as "3,kitchen,photo.jpg", pictures read.
 * @throw ConfigError naming a word that is neither a node of the map nor a picture file
 */
std::vector<GoalWord> parseGoals(const std::string &list, const MapFile &file);

/**
 * Finds the goals in the map. A picture is a mirror picture of the robot's camera, or a panorama of
 * the map's geometry.
 * @throw ConfigError for a picture of another size, RuntimeError for one that surely shows no place
 */
std::vector<NavigationGoal> findGoals(const std::vector<GoalWord> &words, Navigation &navigation,
                                      const MirrorCamera &camera, const PanoramaGeometry &geometry);

} // namespace homeward
