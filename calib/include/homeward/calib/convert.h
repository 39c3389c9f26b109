// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/camera_model.h>

#include <memory>
#include <string>
#include <vector>

namespace homeward
{

/** One model standing for another. */
struct ModelFit
{
  std::shared_ptr<const CameraModel> model; ///< the camera in the other model
  double mean = 0.0;                        ///< distance of the two pixels of a ray, pixels
  double largest = 0.0;                     ///< pixels
  double unseen = 0.0;                      ///< share of the rays that the new model cannot see
};

/** Which parameters of a model a calibration estimates; without distortion, the fewest. */
std::vector<bool> freeParameters(const CameraModel &model, bool distortion);

/** Pixels 1/40 of the picture apart, between two radii round the model's own centre. */
std::vector<Eigen::Vector2d> pixelGrid(const CameraModel &model, double inner = 0.0,
                                       double outer = 1e9);

/**
 * The model `target` that comes nearest to `source` at these pixels, least squares in the picture.
 * @param distortion whether all of its parameters are used, as freeParameters()
 * @throw ConfigError when target is no model's name or source sees too few of the pixels
 */
ModelFit fitModel(const CameraModel &source, const std::string &target,
                  const std::vector<Eigen::Vector2d> &pixels, bool distortion = true);

} // namespace homeward
