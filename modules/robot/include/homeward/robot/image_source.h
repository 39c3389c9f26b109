// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/time.h>

#include <opencv2/core/mat.hpp>
#include <optional>

namespace homeward
{

/** A picture and when it was taken. */
struct Frame
{
  Time stamp{};  ///< when it was taken
  cv::Mat image; ///< CV_8UC1 or CV_8UC3 (BGR)
};

/** Something that takes pictures. */
class ImageSource
{
public:
  virtual ~ImageSource() = default;

  /** The newest picture; nothing when the source has ended. @throw DeviceError when it is gone */
  virtual std::optional<Frame> grab() = 0;

  /** When the newest picture came, of a source that runs by itself; nothing of one that takes a
   * picture when it is asked to. */
  virtual std::optional<Time> newest() const { return std::nullopt; }
};

} // namespace homeward
