// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>

namespace homeward
{

/** How a Video4Linux camera exposes. What is left out stays as it is. */
struct V4l2Settings
{
  std::optional<double> exposure; ///< seconds, for good: the camera no longer chooses
  std::optional<int> gain;        ///< in the camera's own counts, likewise
};

/** ioctl() on a camera: request and argument. @return 0, or -1 with the reason in errno */
using V4l2Ioctl = std::function<int(unsigned long, void *)>;

/**
 * Sets exposure and gain of a camera, automatic control off.
 * @param name of the camera, for messages
 * @throw DeviceError when it has no such control, or none that reaches the value, with its range
 */
void setV4l2Controls(const V4l2Settings &settings, const std::string &name,
                     const V4l2Ioctl &control);

/** The same of a device file. @throw DeviceError also when it does not open */
void setV4l2Controls(const V4l2Settings &settings, const std::string &device);

} // namespace homeward
