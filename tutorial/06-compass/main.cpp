// SPDX-License-Identifier: GPL-3.0-or-later
// Tutorial 06: how far has the robot turned since a panorama was taken? The shift that makes both
// alike says it.
#include "../support/views.h"

#include <homeward/homing/visual_compass.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <cstdio>

using namespace homeward;

/** A panorama with a line of text above. */
cv::Mat titled(const cv::Mat &image, const std::string &title)
{
  cv::Mat picture;
  cv::copyMakeBorder(image, picture, 24, 0, 0, 0, cv::BORDER_CONSTANT, {255, 255, 255});
  cv::putText(picture, title, {4, 17}, cv::FONT_HERSHEY_SIMPLEX, 0.5, {0, 0, 0}, 1, cv::LINE_AA);
  return picture;
}

/** What the panorama would show had the robot not turned by `turn`: columns grow clockwise. */
cv::Mat turnedBack(const Panorama &panorama, double turn)
{
  const int width = panorama.geometry.width;
  const int shift = cvRound(turn / (2.0 * kPi) * width);
  cv::Mat back(panorama.image.size(), panorama.image.type());
  for (int u = 0; u < width; ++u) {
    panorama.image.col((u + shift + width) % width).copyTo(back.col(u));
  }
  return back;
}

int main()
{
  const Laboratory laboratory = loadLaboratory();
  const std::vector<int> turns{-150, -90, -30, 30, 90, 150}; // degrees, left is positive
  std::vector<Pose2> poses;
  poses.reserve(turns.size());
  for (const int turn : turns) {
    poses.push_back({0.0, 0.0, radians(turn)});
  }
  const DataSet before = takePictures(laboratory, {{0.0, 0.0, 0.0}}, LightPreset::Day);
  const DataSet byDay = takePictures(laboratory, poses, LightPreset::Day);
  const DataSet atNight = takePictures(laboratory, poses, LightPreset::Night);

  const Panorama stored = before.panorama(0);
  const auto print = [&](const DataSet &views, std::size_t i, const CompassOptions &options) {
    const auto reading = visualCompass(views.panorama(i), stored, options);
    std::printf("  %5.0f %6s", degrees(reading->headingChange),
                reading->confidence > 0.5 ? "sure" : "unsure");
  };
  std::printf("turned   by day        at night      at night, by edges\n");
  for (std::size_t i = 0; i < turns.size(); ++i) {
    std::printf("%6d", turns[i]);
    print(byDay, i, kZeilCompass);
    print(atNight, i, kZeilCompass);
    print(atNight, i, {});
    std::printf("\n");
  }

  const Panorama now = byDay.panorama(4);
  const std::vector<cv::Mat> rows{titled(stored.image, "stored"),
                                  titled(now.image, "now: the robot has turned left by 90 degrees"),
                                  titled(turnedBack(now, visualCompass(now, stored)->headingChange),
                                         "now, turned back by what the compass reads")};
  cv::Mat picture;
  cv::vconcat(rows, picture);
  cv::imwrite("06-compass.png", picture);
}
