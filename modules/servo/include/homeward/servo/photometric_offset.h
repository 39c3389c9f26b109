// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/pose2.h>
#include <homeward/servo/photometric_sphere.h>

#include <Eigen/Core>

#include <optional>

namespace homeward
{

/** When photometricOffset() gives an answer. */
struct PhotometricOffsetOptions
{
  /** On which brightness is compared. */
  PhotometricOptions sphere = {144, 32, radians(2.5), 2.0, 0.0};
  double reach = 0.3;            ///< largest distance that is believed, metres
  double turn = radians(20.0);   ///< largest turn that is believed, rad
  double leastCorrelation = 0.6; ///< of the two pictures when they are aligned
};

/** Where the camera stands, seen from home. */
struct PhotometricOffset
{
  Pose2 hMp;                  ///< metres, as far as the ranges are right, and rad
  Eigen::Matrix3d covariance; ///< of (x, y, heading) in p, from what is left of the difference
                              ///< and rounding; wrong ranges are not in it
  double correlation = 0.0;   ///< of the two pictures when they are aligned, at most 1
};

/**
 * Planar offset of two panoramas taken a few centimetres and degrees apart. The stored picture is
 * warped as it would look from hMp if everything were at PhotometricSphere::range(); Levenberg and
 * Marquardt's method looks for the hMp from where it equals the current one, gain and offset of the
 * exposure apart. \cite Collewet2011
 *
 * @param visible as in PhotometricSphere(), of both pictures
 * @return nothing when a picture shows nothing, the two stay unlike, the way leads out of reach, or
 * a freedom hardly changes the picture: a hundredth of what the strongest one does, a range's
 * length taken for a radian
 * @throw LogicError when the geometries differ, a picture does not fit its geometry, or options are
 * no use
 */
std::optional<PhotometricOffset> photometricOffset(const Panorama &current, const Panorama &stored,
                                                   const PhotometricOffsetOptions &options = {},
                                                   const cv::Mat &visible = {});

} // namespace homeward
