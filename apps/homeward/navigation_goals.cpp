// SPDX-License-Identifier: GPL-3.0-or-later
#include "navigation_goals.h"

#include "files.h"

#include <homeward/core/error.h>
#include <homeward/dataset/data_set.h>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <filesystem>
#include <sstream>

namespace homeward
{
namespace
{

bool isNumber(const std::string &word)
{
  return word.find_first_not_of("0123456789") == std::string::npos;
}

std::string sizeText(int width, int height)
{
  return std::to_string(width) + " x " + std::to_string(height);
}

/** The gray panorama of a mirror picture, or a picture that is one. */
Panorama panoramaOf(const GoalWord &goal, const MirrorCamera &camera,
                    const PanoramaGeometry &geometry)
{
  const cv::Mat &picture = goal.picture;
  if (picture.size() == cv::Size(camera.model.width(), camera.model.height())) {
    DataSet mirrors(camera, geometry);
    mirrors.followRim({picture});
    return mirrors.panoramaOf(picture, goal.word);
  }
  if (picture.size() != cv::Size(geometry.width, geometry.height)) {
    throw ConfigError(goal.word + " has " + sizeText(picture.cols, picture.rows) +
                      " pixels; a mirror picture of this camera has " +
                      sizeText(camera.model.width(), camera.model.height()) +
                      ", a panorama of this map " + sizeText(geometry.width, geometry.height));
  }
  cv::Mat gray = picture;
  if (gray.channels() == 3) {
    cv::cvtColor(picture, gray, cv::COLOR_BGR2GRAY);
  }
  return {gray, geometry};
}

} // namespace

std::vector<GoalWord> parseGoals(const std::string &list, const MapFile &file)
{
  std::vector<GoalWord> goals;
  std::istringstream words(list + ",");
  for (std::string word; std::getline(words, word, ',');) {
    if (file.map().find(word)) {
      goals.push_back({word, {}});
    }
    else if (!isNumber(word) && std::filesystem::is_regular_file(word)) {
      goals.push_back({word, readPicture(word)});
    }
    else {
      throw ConfigError("the map " + file.path().string() + " has no node " +
                        (word.empty() ? "''" : word) +
                        (isNumber(word) ? "" : ", and there is no picture of that name") +
                        "; homeward map info shows its nodes");
    }
  }
  return goals;
}

std::vector<NavigationGoal> findGoals(const std::vector<GoalWord> &words, Navigation &navigation,
                                      const MirrorCamera &camera, const PanoramaGeometry &geometry)
{
  std::vector<NavigationGoal> goals;
  for (const GoalWord &goal : words) {
    const auto same = std::find_if(goals.begin(), goals.end(), [&](const NavigationGoal &found) {
      return found.word == goal.word;
    });
    if (same != goals.end()) {
      goals.push_back(NavigationGoal(*same));
      continue;
    }
    std::optional<PlaceMatch> shown;
    if (!goal.picture.empty()) {
      shown = navigation.addPicture(goal.word, panoramaOf(goal, camera, geometry));
      if (!shown) {
        throw RuntimeError("no place of the map is surely the one that " + goal.word +
                           " shows; take a picture nearer to a node");
      }
    }
    goals.push_back({goal.word, navigation.map().find(goal.word).value(), shown});
  }
  return goals;
}

} // namespace homeward
