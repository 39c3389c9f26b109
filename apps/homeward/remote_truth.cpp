// SPDX-License-Identifier: GPL-3.0-or-later
#include "remote_truth.h"

#include <homeward/core/error.h>

#include <httplib.h>
#include <nlohmann/json.hpp>

namespace homeward
{
namespace
{

nlohmann::json ask(const std::string &url)
{
  httplib::Client client(url);
  client.set_connection_timeout(std::chrono::seconds(2));
  client.set_read_timeout(std::chrono::seconds(2));
  const httplib::Result answer = client.Get("/truth");
  if (!answer || answer->status != 200) {
    throw DeviceError(url + "/truth: no answer; is it the address of a pioneer-sim?");
  }
  return nlohmann::json::parse(answer->body);
}

Pose2 poseOf(const nlohmann::json &json)
{
  return {json.at(0), json.at(1), json.at(2)};
}

} // namespace

RemoteTruth::RemoteTruth(const std::string &url, const RobotFiles &files)
    : m_url(url), m_files(files)
{
  const nlohmann::json json = ask(m_url);
  m_world = {json.at("world"), json.at("light"), json.at("seed")};
  m_start = poseOf(json.at("start"));
}

Truth RemoteTruth::now() const
{
  const nlohmann::json json = ask(m_url);
  return {poseOf(json.at("pose")), json.at("distance_m"), json.at("collisions"),
          json.at("unseen_contacts")};
}

const FreeSpace &RemoteTruth::freeSpace()
{
  if (!m_simulator) {
    SimulatorOptions options;
    options.start = m_start;
    m_simulator =
        std::make_unique<Simulator>(std::make_shared<const Scene>(loadScene(m_world.world)),
                                    m_files.robot, m_files.camera, options);
  }
  return m_simulator->freeSpace();
}

} // namespace homeward
