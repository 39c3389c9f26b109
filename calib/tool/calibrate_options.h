// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mount_options.h"
#include "target_options.h"

#include <string>
#include <vector>

namespace homeward
{

/** What a calibration with a target is told. */
struct CalibrateOptions
{
  std::vector<std::string> pictures;
  std::string film;
  std::string live;
  std::string keep; ///< folder for the views of a live camera
  int most = 40;    ///< frames of a film, views of a live camera
  TargetOptions target;
  MountOptions mount;
  std::string model = "unified";
  bool noDistortion = false;
  int threads = 2;
  std::string output = "camera.yaml";
  std::string report;
  std::string json;
};

void addCalibrateOptions(CliCommand app, CalibrateOptions &options);

} // namespace homeward
