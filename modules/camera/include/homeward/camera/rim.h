// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/camera_file.h>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include <optional>
#include <vector>

namespace homeward
{

/** Pixels that a camera may have shifted under its mirror and still be followed. */
inline constexpr double kMostRimShift = 8.0;

/**
 * How far the mirror's rim has moved in the picture since the camera was measured: the place of the
 * circle outside which all is the mount's colour. To about 0.05 pixels by day.
 * @param picture CV_8UC1 or CV_8UC3 of the camera's size
 * @return pixels (right, down); nothing where no rim shows within kMostRimShift: darkness, a
 * covered mirror, a camera file without a rim
 * @throw LogicError when size or type differ
 */
std::optional<Eigen::Vector2d> rimShift(const cv::Mat &picture, const MirrorCamera &camera);

/**
 * The camera as it stands now: principal point and rim of a mirror camera move together when it
 * gets a knock, and a degree of elevation is two or three pixels.
 * @param shifts what pictures said; their middle counts, none changes nothing
 */
MirrorCamera followRim(const MirrorCamera &camera, const std::vector<Eigen::Vector2d> &shifts);

} // namespace homeward
