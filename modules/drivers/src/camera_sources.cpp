// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/error.h>
#include <homeward/drivers/camera_sources.h>
#include <homeward/drivers/stream_grabber.h>

#include "visp_frame.h"

#include <filesystem>
#include <utility>
#include <visp3/core/vpException.h>
#include <visp3/sensor/vpV4l2Grabber.h>

#ifdef ENABLE_VISP_NAMESPACE
using namespace VISP_NAMESPACE_NAME;
#endif

namespace homeward
{
namespace
{

/** A stream that is opened again after it broke. */
class StreamCamera final : public ImageSource
{
public:
  StreamCamera(const std::string &url, const StreamOptions &options)
      : m_grabber(url, options.openTimeout, options.readTimeout)
  {
    open();
  }

  std::optional<Frame> grab() override
  {
    if (!m_grabber.init) {
      open();
    }
    if (!std::exchange(m_opened, false)) {
      next();
    }
    return toFrame(m_picture);
  }

private:
  void open()
  {
    try {
      m_grabber.open(m_picture);
      m_opened = true;
    }
    catch (const vpException &error) {
      m_grabber.close();
      throw DeviceError(std::string(error.getStringMessage()) +
                        "; is the camera on and the address right?");
    }
  }

  void next()
  {
    try {
      m_grabber.acquire(m_picture);
    }
    catch (const vpException &error) {
      m_grabber.close();
      throw DeviceError(error.getStringMessage());
    }
  }

  StreamGrabber m_grabber;
  vpImage<vpRGBa> m_picture;
  bool m_opened = false; ///< m_picture has not been given yet
};

#ifdef VISP_HAVE_V4L2
class V4l2Camera final : public ImageSource
{
public:
  V4l2Camera(int device, const V4l2Settings &settings)
      : m_name("/dev/video" + std::to_string(device))
  {
    if (!std::filesystem::exists(m_name)) {
      throw ConfigError(m_name + ": no such camera; is it plugged in?");
    }
    if (settings.exposure || settings.gain) {
      setV4l2Controls(settings, m_name);
    }
    try {
      m_grabber.setDevice(m_name);
      m_grabber.setScale(1);
      m_grabber.open(m_picture);
    }
    catch (const vpException &error) {
      throw DeviceError(m_name + ": " + error.getStringMessage());
    }
  }

  std::optional<Frame> grab() override
  {
    try {
      m_grabber.acquire(m_picture);
    }
    catch (const vpException &error) {
      throw DeviceError(m_name + ": " + error.getStringMessage());
    }
    return toFrame(m_picture);
  }

private:
  std::string m_name;
  vpV4l2Grabber m_grabber;
  vpImage<vpRGBa> m_picture;
};
#endif

} // namespace

std::unique_ptr<ImageSource> openStreamCamera(const std::string &url, const StreamOptions &options)
{
  return std::make_unique<StreamCamera>(url, options);
}

std::unique_ptr<ImageSource> openV4l2Camera(int device, const V4l2Settings &settings)
{
#ifdef VISP_HAVE_V4L2
  return std::make_unique<V4l2Camera>(device, settings);
#else
  static_cast<void>(settings);
  throw ConfigError("camera " + std::to_string(device) + ": this ViSP has no Video4Linux");
#endif
}

} // namespace homeward
