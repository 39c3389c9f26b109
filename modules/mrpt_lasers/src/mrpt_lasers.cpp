// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/error.h>
#include <homeward/drivers/byte_stream.h>
#include <homeward/drivers/steady_clock.h>
#include <homeward/mrpt_lasers/mrpt_lasers.h>

#include <mrpt/hwdrivers/CHokuyoURG.h>
#include <mrpt/hwdrivers/CSickLaserSerial.h>

#include <mutex>
#include <thread>
#include <utility>

namespace homeward
{
namespace
{

using mrpt::hwdrivers::C2DRangeFinderAbstract;
using mrpt::obs::CObservation2DRangeScan;

constexpr Duration kPause = std::chrono::milliseconds(5);

/** MRPT calls a reading beyond the range invalid; here it is far. */
Scan toScan(const CObservation2DRangeScan &seen, Time stamp)
{
  Scan scan;
  scan.stamp = stamp;
  scan.rangeMax = seen.maxRange;
  const std::size_t count = seen.getScanSize();
  scan.angleMin = -static_cast<double>(seen.aperture) / 2.0;
  scan.angleStep = static_cast<double>(seen.aperture) / static_cast<double>(count - 1);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = seen.rightToLeft ? i : count - 1 - i;
    const float range = seen.getScanRange(at);
    const bool known = seen.getScanRangeValidity(at) || range >= seen.maxRange;
    scan.ranges.push_back(known ? range : kUnknownRange);
  }
  return scan;
}

/** One of MRPT's drivers in a thread of its own. */
class MrptLaser final : public LaserScanner
{
public:
  MrptLaser(std::string name, std::unique_ptr<C2DRangeFinderAbstract> driver,
            const MrptLaserOptions &options)
      : m_name(std::move(name)), m_driver(std::move(driver)), m_options(options),
        m_clock(options.clockRate)
  {
    m_driver->setVerbosityLevel(mrpt::system::LVL_ERROR);
    try {
      m_driver->initialize();
    }
    catch (
        const std::exception &) { // with a page of its own source; that no scan comes says enough
    }
    m_thread = std::jthread([this](const std::stop_token &stop) { run(stop); });
    awaitFirstScan();
  }

  std::optional<Scan> scan() override
  {
    const std::lock_guard lock(m_knowing);
    const Duration age = m_clock.now() - m_scan->stamp;
    if (age > m_options.silence) {
      throw DeviceError(m_name + " has been silent for " + std::to_string(toSeconds(age)) + " s");
    }
    return m_scan;
  }

private:
  void awaitFirstScan()
  {
    SteadyClock wall;
    const Time deadline = wall.now() + m_options.start;
    while (wall.now() < deadline) {
      {
        const std::lock_guard lock(m_knowing);
        if (m_scan) {
          return;
        }
      }
      wall.sleepUntil(wall.now() + kPause);
    }
    throw DeviceError(m_name + ": no scan comes; is it on and the address right?");
  }

  void run(const std::stop_token &stop)
  {
    while (!stop.stop_requested()) {
      if (!takeNext()) {
        m_clock.sleepUntil(m_clock.now() + kPause);
      }
    }
  }

  /** @return whether there was a scan */
  bool takeNext()
  {
    CObservation2DRangeScan seen;
    bool came = false;
    bool broken = false;
    try {
      m_driver->doProcessSimple(came, seen, broken);
    }
    catch (const std::exception &) { // it is asked again, and counts as silent meanwhile
      return false;
    }
    if (!came || broken || seen.getScanSize() < 2) {
      return false;
    }
    const std::lock_guard lock(m_knowing);
    m_scan = toScan(seen, m_clock.now());
    return true;
  }

  std::string m_name;
  std::unique_ptr<C2DRangeFinderAbstract> m_driver;
  MrptLaserOptions m_options;
  SteadyClock m_clock;

  std::mutex m_knowing;
  std::optional<Scan> m_scan;

  std::jthread m_thread; ///< last: it uses all of the above
};

} // namespace

std::unique_ptr<LaserScanner> openHokuyo(const std::string &address,
                                         const MrptLaserOptions &options)
{
  auto driver = std::make_unique<mrpt::hwdrivers::CHokuyoURG>();
  if (const std::optional<TcpAddress> tcp = parseTcpAddress(address)) {
    driver->setIPandPort(tcp->host, static_cast<unsigned>(tcp->port));
  }
  else {
    driver->setSerialPort(address);
  }
  return std::make_unique<MrptLaser>("Hokuyo laser at " + address, std::move(driver), options);
}

std::unique_ptr<LaserScanner> openMrptSick(const std::string &path, int resolution,
                                           const MrptLaserOptions &options)
{
  constexpr int kBaud = 38400;
  constexpr int kFieldOfView = 180;
  auto driver = std::make_unique<mrpt::hwdrivers::CSickLaserSerial>();
  driver->setSerialPort(path);
  driver->setBaudRate(kBaud);
  driver->setMillimeterMode(true);
  driver->setScanFOV(kFieldOfView);
  driver->setScanResolution(resolution);
  return std::make_unique<MrptLaser>("SICK laser at " + path, std::move(driver), options);
}

} // namespace homeward
