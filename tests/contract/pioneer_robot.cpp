// SPDX-License-Identifier: GPL-3.0-or-later
#include "contract_room.h"
#include "device_contract.h"
#include "sim_process.h"
#include "test_paths.h"

#include <homeward/core/angle.h>
#include <homeward/drivers/camera_sources.h>
#include <homeward/drivers/live_camera.h>
#include <homeward/drivers/pioneer_base.h>
#include <homeward/drivers/sick_laser.h>

namespace homeward
{
namespace
{

/** How much faster than we the robot lives. */
constexpr double kSpeed = 2.0;

std::vector<std::string> inTheContractRoom()
{
  const auto room =
      std::filesystem::path(HOMEWARD_DATA_DIR).parent_path() / "tests/contract/contract_room.sdf";
  return {"--world", room.string(),          "--start",   "4,5,0",
          "--speed", std::to_string(kSpeed), "--threads", "1"};
}

PioneerOptions pioneerOptions(PioneerLaser laser)
{
  PioneerOptions options;
  options.limits = {0.5, radians(60.0), 0.3, 0.5, radians(100.0)};
  options.laser = laser;
  options.clockRate = kSpeed;
  return options;
}

std::unique_ptr<ImageSource> camera(const SimProcess &sim)
{
  CaptureOptions options;
  options.clockRate = kSpeed;
  options.start = std::chrono::seconds(30);
  return std::make_unique<LiveCamera>(openStreamCamera(sim.stream()), options);
}

/** The drivers of the real robot, connected to a pioneer-sim in a process of its own. */
class PioneerRobot : public ContractRobot
{
public:
  Clock &clock() override { return m_clock; }
  MobileBase *base() override { return m_base.get(); }
  ImageSource *camera() override { return m_camera.get(); }

protected:
  PioneerRobot(PioneerLaser laser, bool serial, bool withCamera)
      : m_camera(withCamera ? homeward::camera(m_sim) : nullptr),
        m_base(std::make_unique<PioneerBase>(
            openStream(serial ? m_sim.arcosPty() : m_sim.arcosTcp(), 9600), pioneerOptions(laser)))
  {}

  void awaitScan()
  {
    while (!laser()->scan()) {
      m_clock.sleepUntil(m_clock.now() + std::chrono::milliseconds(20));
    }
  }

  SimProcess m_sim{inTheContractRoom()};
  SteadyClock m_clock{kSpeed};
  std::unique_ptr<ImageSource> m_camera;
  std::unique_ptr<PioneerBase> m_base;
};

/** ARCOS over TCP with the laser on the same connection; the camera as MJPEG over HTTP. */
class NetworkRobot final : public PioneerRobot
{
public:
  explicit NetworkRobot(PioneerLaser laser) : PioneerRobot(laser, false, true) { awaitScan(); }
  LaserScanner *laser() override { return &m_base->laser(); }
};

/** ARCOS over one serial line, a LMS-200 over another. */
class SerialRobot final : public PioneerRobot
{
public:
  SerialRobot()
      : PioneerRobot(PioneerLaser::None, true, false),
        m_laser(openStream(m_sim.lmsPty(), 9600), sickOptions())
  {
    awaitScan();
  }
  LaserScanner *laser() override { return &m_laser; }

private:
  static SickOptions sickOptions()
  {
    SickOptions options;
    options.clockRate = kSpeed;
    return options;
  }

  SickLaser m_laser;
};

INSTANTIATE_TEST_SUITE_P(
    Pioneer, DeviceContract,
    testing::Values(
        ContractParameter{"arcos_tcp_mjpeg",
                          [] { return std::make_unique<NetworkRobot>(PioneerLaser::Plain); }},
        ContractParameter{"arcos_tcp_extended",
                          [] { return std::make_unique<NetworkRobot>(PioneerLaser::Extended); }},
        ContractParameter{"arcos_pty_lms200", [] { return std::make_unique<SerialRobot>(); }}));

} // namespace
} // namespace homeward
