// SPDX-License-Identifier: GPL-3.0-or-later
#include "aligned_views.h"

#include <homeward/camera/gray_picture.h>
#include <homeward/core/error.h>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace homeward
{

namespace
{

/** Samples averaged in each direction for a pixel of the grid. */
constexpr int kSamples = 2;

/** The grid of the compass: coarse, so that small movements matter little. */
constexpr int kCompassColumns = 72;
constexpr int kCompassRows = 16;

/** Added to gray levels before the logarithm. */
constexpr double kDarkLevel = 4.0;

/** Mean and standard deviation of the levels that are compared. */
constexpr double kMiddle = 128.0;
constexpr double kSpread = 40.0;

/** Standard deviation of the log intensity of a blank picture. */
constexpr double kBlank = 0.01;

/** What a view turned left by `turn` shows on the grid of `geometry`; CV_8U. */
cv::Mat sampled(const Panorama &panorama, const PanoramaGeometry &geometry, double turn)
{
  PanoramaGeometry fine = geometry;
  fine.width *= kSamples;
  fine.height *= kSamples;
  cv::Mat u(fine.height, fine.width, CV_32F);
  cv::Mat v(fine.height, fine.width, CV_32F);
  for (int row = 0; row < fine.height; ++row) {
    v.row(row).setTo(panorama.geometry.row(fine.elevation(row)));
    for (int column = 0; column < fine.width; ++column) {
      u.at<float>(row, column) =
          static_cast<float>(panorama.geometry.column(fine.azimuth(column) + turn));
    }
  }
  // Beyond the seam the picture goes on with its other side; above and below it does not.
  cv::Mat wrapped;
  cv::copyMakeBorder(grayPicture(panorama), wrapped, 0, 0, 1, 1, cv::BORDER_WRAP);
  u += 1.0;
  cv::Mat seen;
  cv::remap(wrapped, seen, u, v, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  cv::Mat small;
  cv::resize(seen, small, {geometry.width, geometry.height}, 0.0, 0.0, cv::INTER_AREA);
  return small;
}

/** Log intensity with one mean and spread whatever the exposure; all the same when blank. */
Panorama standardised(const Panorama &panorama, const PanoramaGeometry &geometry)
{
  cv::Mat logs;
  sampled(panorama, geometry, 0.0).convertTo(logs, CV_32F, 1.0, kDarkLevel);
  cv::log(logs, logs);
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(logs, mean, deviation);
  const double scale = deviation[0] > kBlank ? kSpread / deviation[0] : 0.0;
  Panorama result{{}, geometry};
  logs.convertTo(result.image, CV_8U, scale, kMiddle - scale * mean[0]);
  return result;
}

std::optional<CompassReading> readCompass(const Panorama &current, const Panorama &snapshot,
                                          PanoramaGeometry geometry)
{
  geometry.width = kCompassColumns;
  geometry.height = kCompassRows;
  return visualCompass(standardised(current, geometry), standardised(snapshot, geometry));
}

} // namespace

std::optional<AlignedViews> alignByCompass(const Panorama &current, const Panorama &snapshot,
                                           int width, int height)
{
  AlignedViews views;
  views.geometry = {width, height,
                    std::max(current.geometry.elevationMin, snapshot.geometry.elevationMin),
                    std::min(current.geometry.elevationMax, snapshot.geometry.elevationMax)};
  if (!(views.geometry.elevationMin < views.geometry.elevationMax)) {
    throw LogicError("the panoramas show no elevation in common");
  }
  const std::optional<CompassReading> reading = readCompass(current, snapshot, views.geometry);
  if (!reading) {
    return std::nullopt;
  }
  views.compass = *reading;
  sampled(current, views.geometry, 0.0).convertTo(views.current, CV_32F);
  sampled(snapshot, views.geometry, reading->headingChange).convertTo(views.snapshot, CV_32F);
  return views;
}

} // namespace homeward
