// SPDX-License-Identifier: GPL-3.0-or-later
// Panoramas of the laboratory for the tutorials that look and do not drive.
#pragma once

#include "laboratory.h"

#include <homeward/evaluation/rendered_views.h>

#include <vector>

/** A picture of the laboratory from each pose; DataSet::panorama() unwarps them. */
inline homeward::DataSet takePictures(const Laboratory &laboratory,
                                      const std::vector<homeward::Pose2> &poses,
                                      homeward::LightPreset light)
{
  const homeward::ViewSource source{laboratory.scene, laboratory.robot.rMp, laboratory.camera};
  homeward::DataSet views(laboratory.camera);
  homeward::addRenderedViews(views, source, poses, light);
  views.followRim(); // the simulated camera has had a knock, like any real one
  return views;
}
