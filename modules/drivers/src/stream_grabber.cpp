// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/drivers/stream_grabber.h>

#include <utility>
#include <vector>
#include <visp3/core/vpFrameGrabberException.h>
#include <visp3/core/vpImageConvert.h>

#ifdef ENABLE_VISP_NAMESPACE
using namespace VISP_NAMESPACE_NAME;
#endif

namespace homeward
{

StreamGrabber::StreamGrabber(std::string url, std::chrono::milliseconds openTimeout,
                             std::chrono::milliseconds readTimeout)
    : m_url(std::move(url)), m_openTimeout(openTimeout), m_readTimeout(readTimeout)
{}

void StreamGrabber::open()
{
  const std::vector<int> settings{
      cv::CAP_PROP_OPEN_TIMEOUT_MSEC, static_cast<int>(m_openTimeout.count()),
      cv::CAP_PROP_READ_TIMEOUT_MSEC, static_cast<int>(m_readTimeout.count())};
  if (!m_capture.open(m_url, cv::CAP_FFMPEG, settings)) {
    throw vpFrameGrabberException(vpFrameGrabberException::initializationError,
                                  m_url + ": cannot open the stream");
  }
  width = static_cast<unsigned>(m_capture.get(cv::CAP_PROP_FRAME_WIDTH));
  height = static_cast<unsigned>(m_capture.get(cv::CAP_PROP_FRAME_HEIGHT));
  init = true;
}

void StreamGrabber::open(vpImage<unsigned char> &picture)
{
  open();
  acquire(picture);
}

void StreamGrabber::open(vpImage<vpRGBa> &picture)
{
  open();
  acquire(picture);
}

cv::Mat StreamGrabber::next()
{
  cv::Mat picture;
  if (!m_capture.isOpened() || !m_capture.read(picture)) {
    throw vpFrameGrabberException(vpFrameGrabberException::otherError,
                                  m_url + ": no picture came in time");
  }
  return picture;
}

void StreamGrabber::acquire(vpImage<unsigned char> &picture)
{
  vpImageConvert::convert(next(), picture);
}

void StreamGrabber::acquire(vpImage<vpRGBa> &picture)
{
  vpImageConvert::convert(next(), picture);
}

void StreamGrabber::close()
{
  m_capture.release();
  init = false;
}

} // namespace homeward
