// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <opencv2/videoio.hpp>
#include <string>
#include <visp3/core/vpFrameGrabber.h>

namespace homeward
{

#ifdef ENABLE_VISP_NAMESPACE
using VISP_NAMESPACE_NAME::vpFrameGrabber;
using VISP_NAMESPACE_NAME::vpImage;
using VISP_NAMESPACE_NAME::vpRGBa;
#endif

/**
 * Any stream that OpenCV's FFmpeg opens as a ViSP frame grabber, with read timeouts; Debian's ViSP
 * has no vpOpenCVGrabber for this OpenCV. C++17, for ViSP's sake.
 */
class StreamGrabber final : public vpFrameGrabber
{
public:
  /** Opens nothing yet. @param url of the stream; timeouts of opening and of one picture */
  StreamGrabber(std::string url, std::chrono::milliseconds openTimeout,
                std::chrono::milliseconds readTimeout);

  /** Opens the stream and takes its first picture. @throw vpFrameGrabberException */
  void open(vpImage<unsigned char> &picture) override;
  void open(vpImage<vpRGBa> &picture) override;

  /** The next picture. @throw vpFrameGrabberException when none comes in time */
  void acquire(vpImage<unsigned char> &picture) override;
  void acquire(vpImage<vpRGBa> &picture) override;

  void close() override;

private:
  void open();
  cv::Mat next();

  std::string m_url;
  std::chrono::milliseconds m_openTimeout;
  std::chrono::milliseconds m_readTimeout;
  cv::VideoCapture m_capture;
};

} // namespace homeward
