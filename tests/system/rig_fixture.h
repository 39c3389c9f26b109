// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "program.h"
#include "sim_process.h"
#include "test_paths.h"

#include <gtest/gtest.h>
#include <httplib.h>
#include <nlohmann/json.hpp>

namespace homeward
{

/** A pioneer-sim in the contract room, three times as fast as we, and the rig that names it. */
class RigTest : public testing::Test
{
protected:
  static std::vector<std::string> arguments()
  {
    const auto room =
        std::filesystem::path(HOMEWARD_DATA_DIR).parent_path() / "tests/contract/contract_room.sdf";
    return {"--world", room.string(), "--start", "4,5,0", "--threads", "1", "--speed", "3"};
  }

  std::string rigFile(const std::string &camera = "") const
  {
    std::string file = folder / "rig.yaml";
    std::ofstream(file) << "robot: " << (dataDir() / "robots/pioneer3at.urdf").string() << "\n"
                        << "camera: "
                        << (camera.empty() ? (dataDir() / "cameras/sim_nominal.yaml").string()
                                           : camera)
                        << "\nbase: {address: '" << address << "'"
                        << (base.empty() ? "" : ", " + base) << "}\n"
                        << "laser: {kind: lms200, address: " << sim.lmsPty() << "}\n"
                        << "capture: {kind: stream, period_s: 0.5, source: '" << sim.stream()
                        << "'}\n"
                        << "clock_rate: 3\n"
                        << more;
    return file;
  }

  std::string truthUrl() const { return "http://127.0.0.1:" + std::to_string(sim.httpPort()); }

  /** What only the simulator knows. */
  nlohmann::json truth() const
  {
    const auto answer = httplib::Client("127.0.0.1", sim.httpPort()).Get("/truth");
    return answer ? nlohmann::json::parse(answer->body) : nlohmann::json::object();
  }

  /** Whether the robot moves. */
  bool moves() const
  {
    const nlohmann::json now = truth();
    return now.value("v_m_s", 0.0) != 0.0 || now.value("w_rad_s", 0.0) != 0.0;
  }

  /** Sets a fault of pioneer-sim's. */
  void fault(const std::string &name, bool on) const
  {
    const auto answer = httplib::Client("127.0.0.1", sim.httpPort())
                            .Post("/fault/" + name + (on ? "?on=1" : "?on=0"));
    EXPECT_TRUE(answer && answer->status == 200);
  }

  Folder folder;
  SimProcess sim{arguments()};
  std::string address = sim.arcosTcp(); ///< of the base
  std::string base;                     ///< more of its keys
  std::string more;                     ///< lines at the end of the rig
};

} // namespace homeward
