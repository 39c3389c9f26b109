// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/drivers/v4l2_controls.h>

#include <homeward/core/error.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <fcntl.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <system_error>
#include <unistd.h>

namespace homeward
{
namespace
{

constexpr double kExposureUnit = 1e-4; ///< seconds in one count of the absolute exposure

std::string reason(int error)
{
  return std::generic_category().message(error);
}

/** The camera's controls, by their numbers. */
class Controls
{
public:
  Controls(const std::string &name, const V4l2Ioctl &control) : m_name(name), m_control(control) {}

  std::optional<v4l2_queryctrl> find(std::uint32_t id) const
  {
    v4l2_queryctrl query{};
    query.id = id;
    if (m_control(VIDIOC_QUERYCTRL, &query) != 0 || (query.flags & V4L2_CTRL_FLAG_DISABLED) != 0) {
      return std::nullopt;
    }
    return query;
  }

  void set(std::uint32_t id, const std::string &what, std::int32_t value) const
  {
    v4l2_control control{id, value};
    if (m_control(VIDIOC_S_CTRL, &control) != 0) {
      throw DeviceError(m_name + ": refuses " + what + ": " + reason(errno));
    }
  }

  /** Switches automatic control off where there is one. */
  void switchOff(std::uint32_t id, const std::string &what, std::int32_t manual) const
  {
    if (find(id)) {
      set(id, what, manual);
    }
  }

  /**
   * Sets what has a range.
   * @param key of the rig file @param value in its unit @param unit of one count, in that of the
   * key
   */
  void set(std::uint32_t id, const std::string &key, double value, double unit) const
  {
    const std::optional<v4l2_queryctrl> range = find(id);
    if (!range) {
      throw DeviceError(m_name + ": this camera has no control for '" + key + "'; leave it out");
    }
    const auto text = [&](double number) {
      std::string digits = std::to_string(number);
      digits.erase(digits.find_last_not_of('0') + 1);
      return digits.ends_with('.') ? digits.substr(0, digits.size() - 1) : digits;
    };
    const double counts = value / unit;
    if (!(counts > range->minimum - 0.5 && counts < range->maximum + 0.5)) {
      throw DeviceError(m_name + ": '" + key + "' is " + text(value) + "; this camera takes " +
                        text(range->minimum * unit) + " to " + text(range->maximum * unit));
    }
    const double step = std::max(range->step, 1);
    const double whole = range->minimum + step * std::round((counts - range->minimum) / step);
    set(id, "'" + key + "'", static_cast<std::int32_t>(std::min<double>(whole, range->maximum)));
  }

private:
  const std::string &m_name;
  const V4l2Ioctl &m_control;
};

} // namespace

void setV4l2Controls(const V4l2Settings &settings, const std::string &name,
                     const V4l2Ioctl &control)
{
  constexpr double kMillisecond = 1e3;
  const Controls controls(name, control);
  if (settings.exposure) {
    controls.switchOff(V4L2_CID_EXPOSURE_AUTO, "manual exposure", V4L2_EXPOSURE_MANUAL);
    controls.set(V4L2_CID_EXPOSURE_ABSOLUTE, "exposure_ms", *settings.exposure * kMillisecond,
                 kExposureUnit * kMillisecond);
  }
  if (settings.gain) {
    controls.switchOff(V4L2_CID_AUTOGAIN, "manual gain", 0);
    controls.set(V4L2_CID_GAIN, "gain", *settings.gain, 1.0);
  }
}

void setV4l2Controls(const V4l2Settings &settings, const std::string &device)
{
  const int descriptor = ::open(device.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) {
    throw DeviceError(device + ": cannot open: " + reason(errno));
  }
  try {
    setV4l2Controls(settings, device, [descriptor](unsigned long request, void *argument) {
      return ::ioctl(descriptor, request, argument);
    });
  }
  catch (const DeviceError &) {
    ::close(descriptor);
    throw;
  }
  ::close(descriptor);
}

} // namespace homeward
