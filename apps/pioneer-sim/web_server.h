// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "faults.h"
#include "mirror_feed.h"

#include <functional>
#include <httplib.h>
#include <string>
#include <thread>

namespace homeward
{

/**
 * What pioneer-sim serves over HTTP: `/camera.mjpg` (the camera as a stream of JPEGs),
 * `/camera.jpg` (one picture), `/truth` (JSON), and `POST /fault/NAME?on=1` or `on=0` (Faults).
 */
class WebServer
{
public:
  /**
   * @param port 0 lets the system choose
   * @param truth JSON of what only the simulator knows; called on any thread
   * @throw DeviceError when the port is taken
   */
  WebServer(const std::string &host, int port, MirrorFeed &feed, std::function<std::string()> truth,
            Faults &faults);
  ~WebServer();
  WebServer(const WebServer &) = delete;
  WebServer &operator=(const WebServer &) = delete;

  int port() const { return m_port; }

private:
  void addCamera(MirrorFeed &feed, const Faults &faults);
  void addFaults(Faults &faults);

  httplib::Server m_server;
  int m_port = 0;
  std::jthread m_thread;
};

} // namespace homeward
