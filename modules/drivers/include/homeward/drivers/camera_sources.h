// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/robot/image_source.h>

#include <chrono>
#include <memory>
#include <string>

namespace homeward
{

/** How a stream over the network is read. Durations are the machine's. */
struct StreamOptions
{
  std::chrono::milliseconds openTimeout{3000};
  std::chrono::milliseconds readTimeout{1000};
};

/**
 * A stream of pictures (MJPEG over HTTP, RTSP, anything FFmpeg opens), CV_8UC3, each once. A stream
 * that breaks is opened again.
 * @throw DeviceError when it cannot be opened
 */
std::unique_ptr<ImageSource> openStreamCamera(const std::string &url,
                                              const StreamOptions &options = {});

/**
 * A camera of Video4Linux, CV_8UC3, each picture once.
 * @param device number N of /dev/videoN
 * @throw ConfigError when there is no such device; DeviceError when it gives no pictures
 */
std::unique_ptr<ImageSource> openV4l2Camera(int device);

} // namespace homeward
