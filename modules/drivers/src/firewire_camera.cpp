// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/error.h>
#include <homeward/drivers/camera_sources.h>

#include "visp_frame.h"

#include <visp3/core/vpConfig.h>
#include <visp3/core/vpException.h>

#if defined(VISP_HAVE_DC1394) && __has_include(<dc1394/dc1394.h>)
#include <visp3/sensor/vp1394TwoGrabber.h>
#define HOMEWARD_HAS_FIREWIRE
#endif

namespace homeward
{
namespace
{

#ifdef HOMEWARD_HAS_FIREWIRE

class FirewireCamera final : public ImageSource
{
public:
  FirewireCamera(int number, const FirewireSettings &settings)
      : m_name("FireWire camera " + std::to_string(number))
  {
    attempt([&] {
      m_grabber.setCamera(static_cast<std::uint64_t>(number));
      if (settings.shutter) {
        m_grabber.setAutoShutter(false);
        m_grabber.setParameterValue(vp1394TwoGrabber::vpFEATURE_SHUTTER,
                                    static_cast<unsigned>(*settings.shutter));
      }
      if (settings.gain) {
        m_grabber.setAutoGain(false);
        m_grabber.setParameterValue(vp1394TwoGrabber::vpFEATURE_GAIN,
                                    static_cast<unsigned>(*settings.gain));
      }
      m_grabber.open(m_picture);
    });
  }

  std::optional<Frame> grab() override
  {
    attempt([this] { m_grabber.acquire(m_picture); });
    return toFrame(m_picture);
  }

private:
  template <class Action> void attempt(const Action &action)
  {
    try {
      action();
    }
    catch (const vpException &error) {
      throw DeviceError(m_name + ": " + error.getStringMessage());
    }
  }

  std::string m_name;
  vp1394TwoGrabber m_grabber{false}; ///< no reset of the bus: others may be on it
  vpImage<vpRGBa> m_picture;
};

#endif

} // namespace

std::unique_ptr<ImageSource> openFirewireCamera(int number, const FirewireSettings &settings)
{
#ifdef HOMEWARD_HAS_FIREWIRE
  try {
    return std::make_unique<FirewireCamera>(number, settings);
  }
  catch (const vpException &error) { // of the bus, before any camera
    throw DeviceError("FireWire camera " + std::to_string(number) + ": " +
                      error.getStringMessage());
  }
#else
  static_cast<void>(settings);
  throw ConfigError("FireWire camera " + std::to_string(number) + ": this ViSP has no libdc1394");
#endif
}

} // namespace homeward
