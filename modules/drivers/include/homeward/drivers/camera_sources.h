// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/drivers/v4l2_controls.h>
#include <homeward/robot/image_source.h>

#include <chrono>
#include <memory>
#include <optional>
#include <string>

namespace homeward
{

/** How a stream over the network is read. Durations are the machine's. */
struct StreamOptions
{
  std::chrono::milliseconds openTimeout{3000}; ///< after which opening fails
  std::chrono::milliseconds readTimeout{1000}; ///< after which the stream counts as lost
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
 * @throw ConfigError when there is no such device; DeviceError when it gives no pictures or refuses
 * a setting
 */
std::unique_ptr<ImageSource> openV4l2Camera(int device, const V4l2Settings &settings = {});

/** How a FireWire camera exposes, in its own counts. What is left out stays as it is. */
struct FirewireSettings
{
  std::optional<int> shutter; ///< in the camera's own units; none: by itself
  std::optional<int> gain;    ///< in the camera's own units; none: by itself
};

/**
 * A camera on the FireWire bus (IEEE 1394, IIDC), CV_8UC3, each picture once.
 * @param number from 0 in the order of the bus
 * @throw DeviceError when there is none, it gives no pictures or refuses a setting; ConfigError
 * when ViSP was built without libdc1394
 */
std::unique_ptr<ImageSource> openFirewireCamera(int number, const FirewireSettings &settings = {});

} // namespace homeward
