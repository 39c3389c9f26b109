// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/calib/bearing_tracks.h>

#include <homeward/core/error.h>

#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include <cmath>

namespace homeward
{
namespace
{

constexpr int kMost = 200;        ///< corners followed at a time
constexpr double kApart = 10.0;   ///< pixels between corners
constexpr double kQuality = 0.02; ///< of the strongest corner
constexpr int kWindow = 15;       ///< pixels round a corner that are compared
constexpr double kReturn = 0.5;   ///< pixels off that a corner may be, followed there and back
constexpr int kCornerSize = 5;    ///< pixels round a corner that make it one

/** A corner that is followed. */
struct Corner
{
  int landmark = 0;
  cv::Point2f pixel; ///< of the panorama of the last view
};

/** Columns that are repeated on both sides, so that the seam is no border. */
int marginOf(const PanoramaGeometry &geometry)
{
  return geometry.width / 4;
}

/** Noise sees to it that no two pictures are the same, least of all of two places. */
void refuseFrozen(const std::vector<DriveView> &drive, std::size_t i)
{
  const Pose2 step = drive[i - 1].oMr.inverse() * drive[i].oMr;
  const bool moved = step.translation().norm() > 0.01 || std::abs(step.heading) > 0.01;
  if (moved && cv::norm(drive[i - 1].panorama.image, drive[i].panorama.image, cv::NORM_INF) == 0) {
    throw ConfigError("pictures " + std::to_string(i - 1) + " and " + std::to_string(i) +
                      " of the drive are the same although the robot moved; the camera was "
                      "frozen: drive again");
  }
}

/** The picture with its first `shift` columns moved to its end, and margins. */
cv::Mat rolled(const cv::Mat &picture, int shift, int margin)
{
  cv::Mat twice;
  cv::repeat(picture, 1, 2, twice);
  cv::Mat wide;
  cv::copyMakeBorder(twice.colRange(shift, shift + picture.cols), wide, 0, 0, margin, margin,
                     cv::BORDER_WRAP | cv::BORDER_ISOLATED);
  return wide;
}

float wrapColumn(float column, int width)
{
  const float rest = std::fmod(column, static_cast<float>(width));
  return rest < 0.0F ? rest + static_cast<float>(width) : rest;
}

void check(const DriveView &view, const PanoramaGeometry &geometry)
{
  if (!(view.panorama.geometry == geometry) || view.panorama.image.type() != CV_8UC1 ||
      view.panorama.image.size() != cv::Size(geometry.width, geometry.height)) {
    throw LogicError("a drive needs gray panoramas of one geometry");
  }
}

/** Adds corners where there are none. */
void replenish(std::vector<Corner> &corners, const cv::Mat &picture, const cv::Mat &visible,
               int &landmarks)
{
  const int wanted = kMost - static_cast<int>(corners.size());
  if (wanted <= 0) {
    return;
  }
  cv::Mat mask =
      visible.empty() ? cv::Mat(picture.size(), CV_8UC1, cv::Scalar(255)) : visible.clone();
  // By the strongest of all corners, not of those still to be had: those may be but noise.
  cv::Mat1f strength;
  double strongest = 0.0;
  cv::cornerMinEigenVal(picture, strength, kCornerSize);
  cv::minMaxLoc(strength, nullptr, &strongest, nullptr, nullptr, mask);
  mask.setTo(0, strength < kQuality * strongest);
  for (const Corner &corner : corners) {
    cv::circle(mask, cv::Point(corner.pixel), static_cast<int>(kApart), cv::Scalar(0), cv::FILLED);
  }
  std::vector<cv::Point2f> found;
  cv::goodFeaturesToTrack(picture, found, wanted, kQuality, kApart, mask, kCornerSize);
  for (const cv::Point2f &pixel : found) {
    corners.push_back({landmarks++, pixel});
  }
}

/** Corners that are seen again, at their new pixels. */
std::vector<Corner> follow(const std::vector<Corner> &corners, const DriveView &before,
                           const DriveView &now)
{
  const PanoramaGeometry &geometry = now.panorama.geometry;
  const int width = geometry.width;
  const int margin = marginOf(geometry);
  // A turn to the left moves the scene to the right; odometry takes most of it away.
  const double turn = wrapAngle(now.oMr.heading - before.oMr.heading);
  const int shift = (static_cast<int>(std::lround(turn * width / (2.0 * kPi))) + width) % width;
  const cv::Mat from = rolled(before.panorama.image, 0, margin);
  const cv::Mat to = rolled(now.panorama.image, shift, margin);
  std::vector<cv::Point2f> start;
  start.reserve(corners.size());
  for (const Corner &corner : corners) {
    start.emplace_back(corner.pixel.x + static_cast<float>(margin), corner.pixel.y);
  }
  std::vector<cv::Point2f> there;
  std::vector<cv::Point2f> back;
  std::vector<unsigned char> seen;
  std::vector<unsigned char> returned;
  std::vector<float> ignored;
  const cv::Size window(kWindow, kWindow);
  cv::calcOpticalFlowPyrLK(from, to, start, there, seen, ignored, window);
  cv::calcOpticalFlowPyrLK(to, from, there, back, returned, ignored, window);
  std::vector<Corner> kept;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (seen[i] != 0 && returned[i] != 0 && cv::norm(back[i] - start[i]) < kReturn) {
      const float column = there[i].x - static_cast<float>(margin) + static_cast<float>(shift);
      kept.push_back({corners[i].landmark, {wrapColumn(column, width), there[i].y}});
    }
  }
  return kept;
}

} // namespace

std::vector<MountSample> trackBearings(const std::vector<DriveView> &drive, const cv::Mat &visible)
{
  std::vector<MountSample> samples;
  std::vector<Corner> corners;
  int landmarks = 0;
  for (std::size_t i = 0; i < drive.size(); ++i) {
    const PanoramaGeometry &geometry = drive.front().panorama.geometry;
    check(drive[i], geometry);
    if (i > 0) {
      refuseFrozen(drive, i);
    }
    if (i > 0 && !corners.empty()) {
      corners = follow(corners, drive[i - 1], drive[i]);
    }
    replenish(corners, drive[i].panorama.image, visible, landmarks);
    MountSample &sample = samples.emplace_back(MountSample{drive[i].oMr, {}});
    for (const Corner &corner : corners) {
      sample.bearings.push_back({corner.landmark, geometry.azimuth(corner.pixel.x)});
    }
  }
  return samples;
}

} // namespace homeward
