// SPDX-License-Identifier: GPL-3.0-or-later
#include "real_robot.h"

#include "files.h"

#include <homeward/core/error.h>
#include <homeward/drivers/camera_sources.h>
#include <homeward/drivers/cola_laser.h>
#include <homeward/drivers/recorded_camera.h>
#include <homeward/drivers/sick_laser.h>

#ifdef HOMEWARD_MRPT_LASERS
#include <homeward/mrpt_lasers/mrpt_lasers.h>
#endif

#include <algorithm>
#include <charconv>
#include <iterator>

namespace homeward
{
namespace
{

int deviceNumber(const std::string &text, const std::string &what)
{
  int number = -1;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), number);
  if (parsed.ec != std::errc() || parsed.ptr != text.data() + text.size() || number < 0) {
    throw ConfigError("'capture.source' is '" + text + "'; the N of " + what + " is expected");
  }
  return number;
}

std::unique_ptr<ImageSource> source(const CaptureLink &link, const std::filesystem::path &rigFile)
{
  const std::string file = (rigFile.parent_path() / link.source).lexically_normal().string();
  switch (link.kind) {
  case CaptureLink::Kind::V4l2:
    return openV4l2Camera(deviceNumber(link.source, "/dev/videoN"), {link.exposure, link.gain});
  case CaptureLink::Kind::Firewire:
    return openFirewireCamera(deviceNumber(link.source, "the Nth camera of the bus, from 0"),
                              {link.shutter, link.gain});
  case CaptureLink::Kind::Files:
    return std::make_unique<FolderCamera>(file, 0);
  case CaptureLink::Kind::Film:
    return std::make_unique<VideoCamera>(file);
  case CaptureLink::Kind::Stream:
    break;
  }
  return openStreamCamera(link.source);
}

std::unique_ptr<LaserScanner> sickLaser(const DeviceLinks &links)
{
  SickOptions options;
  options.baud = links.laser.baud;
  options.resolution = links.laser.resolution;
  options.clockRate = links.clockRate;
  return std::make_unique<SickLaser>(openStream(links.laser.address, 9600), options);
}

std::unique_ptr<LaserScanner> colaLaser(const DeviceLinks &links)
{
  ColaOptions options;
  options.resolution = links.laser.resolution;
  options.clockRate = links.clockRate;
  return std::make_unique<ColaLaser>(openStream(links.laser.address, 0), options);
}

#ifdef HOMEWARD_MRPT_LASERS
std::unique_ptr<LaserScanner> hokuyo(const DeviceLinks &links)
{
  MrptLaserOptions options;
  options.clockRate = links.clockRate;
  return openHokuyo(links.laser.address, options);
}
#else
std::unique_ptr<LaserScanner> hokuyo(const DeviceLinks & /*links*/)
{
  throw ConfigError(
      "'laser.kind' is 'hokuyo', but this program was built without MRPT, which drives "
      "it; install libmrpt-hwdrivers-dev and build again");
}
#endif

/** The speeds to try at a base: the rig's first; a socket has none. */
std::vector<int> baudsOf(const BaseLink &link)
{
  std::vector<int> bauds;
  if (link.address.starts_with('/')) {
    bauds = {link.baud};
    std::copy_if(kSerialBauds.begin(), kSerialBauds.end(), std::back_inserter(bauds),
                 [&](int baud) { return baud != link.baud; });
  }
  return bauds;
}

PioneerBase::OpenLine baseLine(const BaseLink &link)
{
  return [link] { return openStream(link.address, link.baud); };
}

} // namespace

std::optional<AriaParameters> baseParameters(const RobotFiles &files)
{
  const std::filesystem::path &written = files.rig.devices.value().base.parameters;
  if (written.empty()) {
    return std::nullopt;
  }
  const std::string file = (files.rigFile.parent_path() / written).lexically_normal().string();
  return parseAriaParameters(readText(file, "ARIA parameter file"), file);
}

std::unique_ptr<PioneerBase> connectBase(const RobotFiles &files)
{
  const DeviceLinks &links = files.rig.devices.value();
  PioneerOptions options;
  options.limits = files.rig.limits;
  options.sonars = files.robot.sonars;
  options.clockRate = links.clockRate;
  if (links.laser.kind == LaserLink::Kind::OnBase) {
    options.laser = PioneerLaser::Plain;
  }
  options.bauds = baudsOf(links.base);
  if (const std::optional<AriaParameters> parameters = baseParameters(files)) {
    options.units = parameters->units;
  }
  return std::make_unique<PioneerBase>(baseLine(links.base)(), options);
}

std::unique_ptr<LaserScanner> connectLaser(const RobotFiles &files)
{
  const DeviceLinks &links = files.rig.devices.value();
  switch (links.laser.kind) {
  case LaserLink::Kind::Lms200:
    return sickLaser(links);
  case LaserLink::Kind::Lms1xx:
    return colaLaser(links);
  case LaserLink::Kind::Hokuyo:
    return hokuyo(links);
  case LaserLink::Kind::OnBase:
    break;
  }
  return nullptr;
}

std::unique_ptr<LiveCamera> connectCamera(const RobotFiles &files)
{
  const DeviceLinks &links = files.rig.devices.value();
  const CaptureLink &link = links.capture;
  const bool recorded =
      link.kind == CaptureLink::Kind::Files || link.kind == CaptureLink::Kind::Film;
  CaptureOptions options;
  options.latency = fromSeconds(link.latency * links.clockRate);
  options.period = recorded ? fromSeconds(link.period) : Duration{};
  options.start = fromSeconds(toSeconds(options.start) * links.clockRate);
  options.clockRate = links.clockRate;
  return std::make_unique<LiveCamera>(source(link, files.rigFile), options);
}

RealRobot::RealRobot(const RobotFiles &files)
    : m_openBase(baseLine(files.rig.devices.value().base)),
      m_clock(files.rig.devices.value().clockRate), m_camera(connectCamera(files)),
      m_laser(connectLaser(files)), m_base(connectBase(files))
{
  const Time deadline = m_clock.now() + std::chrono::seconds(5);
  while (!laser().scan()) {
    if (m_clock.now() > deadline) {
      throw DeviceError("the laser answers but measures nothing");
    }
    m_clock.sleepUntil(m_clock.now() + std::chrono::milliseconds(20));
  }
}

LaserScanner &RealRobot::laser()
{
  return m_laser ? *m_laser : m_base->laser();
}

std::string RealRobot::baseFault()
{
  try {
    return m_base->state().halt;
  }
  catch (const DeviceError &error) {
    return error.what();
  }
}

bool RealRobot::bringBack(const ReconnectOptions &options, const std::atomic<bool> &stop,
                          const std::function<void(const std::string &)> &say)
{
  try {
    m_base->state();
    return true;
  }
  catch (const DeviceError &) { // lost
    return reconnect(*m_base, m_openBase, options, stop, say);
  }
}

Devices RealRobot::devices()
{
  return {m_clock, *m_base, laser(), *m_camera};
}

} // namespace homeward
