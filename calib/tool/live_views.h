// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pictures.h"

#include <homeward/calib/target.h>
#include <homeward/robot/image_source.h>

#include <atomic>
#include <memory>
#include <string>

namespace homeward
{

/** Which views are taken of a live camera, and where they stay. */
struct WatchOptions
{
  int most = 40;    ///< views
  std::string keep; ///< folder, made when missing, for each view as it is taken; empty: none
};

/**
 * Watches a source until its views will do, there are enough, or somebody stops it, and says on
 * standard error what to do with the board next.
 * @param name of the source, for the pictures' names
 * @return pictures with boards, each unlike the others
 * @throw ConfigError when no board was seen; DeviceError when the camera is gone
 */
Pictures watch(ImageSource &source, const std::string &name, const Target &target,
               const WatchOptions &options, const std::atomic<bool> &stop);

/**
 * A camera that runs by itself, through ViSP's grabbers.
 * @param name `/dev/videoN`, or the URL of a stream (MJPEG over HTTP, RTSP)
 * @throw ConfigError when it is neither, or there is no such device; DeviceError when it is silent
 */
std::unique_ptr<ImageSource> openLiveCamera(const std::string &name);

} // namespace homeward
