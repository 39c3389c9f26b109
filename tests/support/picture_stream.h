// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <httplib.h>

#include <atomic>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

namespace homeward
{

/** A camera on the network: JPEG pictures one after another, over and over, as MJPEG over HTTP. */
class PictureStream
{
public:
  /** @param lastly how many are sent, to whomever, before the camera falls silent; 0: it never does
   */
  PictureStream(std::vector<std::string> jpegs, std::chrono::milliseconds period, int lastly = 0)
      : m_jpegs(std::move(jpegs))
  {
    m_server.Get("/", [this, period, lastly](const httplib::Request &,
                                             httplib::Response &response) {
      response.set_content_provider(
          "multipart/x-mixed-replace; boundary=frame",
          [this, period, lastly](std::size_t, httplib::DataSink &sink) {
            std::this_thread::sleep_for(period);
            if (lastly > 0 && m_sent >= lastly) {
              return !m_over && sink.is_writable();
            }
            const std::string &jpeg = m_jpegs[static_cast<std::size_t>(m_sent++) % m_jpegs.size()];
            const std::string part = "--frame\r\nContent-Type: image/jpeg\r\nContent-Length: " +
                                     std::to_string(jpeg.size()) + "\r\n\r\n" + jpeg + "\r\n";
            return !m_over && sink.write(part.data(), part.size());
          });
    });
    m_port = m_server.bind_to_any_port("127.0.0.1");
    m_thread = std::jthread([this] { m_server.listen_after_bind(); });
    while (!m_server.is_running()) {
      std::this_thread::yield(); // stop() before it runs would be lost
    }
  }

  ~PictureStream()
  {
    m_over = true;
    m_server.stop();
  }

  PictureStream(const PictureStream &) = delete;
  PictureStream &operator=(const PictureStream &) = delete;

  std::string url() const { return "http://127.0.0.1:" + std::to_string(m_port) + "/"; }

private:
  std::vector<std::string> m_jpegs;
  std::atomic<bool> m_over = false;
  std::atomic<int> m_sent = 0;
  httplib::Server m_server;
  int m_port = 0;
  std::jthread m_thread;
};

} // namespace homeward
