// SPDX-License-Identifier: GPL-3.0-or-later
#include "web_server.h"

#include <homeward/core/error.h>

namespace homeward
{
namespace
{

constexpr std::chrono::milliseconds kPatience{500};
constexpr std::size_t kClients = 16; ///< each stream holds a thread

std::string partHeader(std::size_t size)
{
  return "--frame\r\nContent-Type: image/jpeg\r\nContent-Length: " + std::to_string(size) +
         "\r\n\r\n";
}

/** Sends the next picture, if one comes. @return false when the client has left, or is left */
bool sendNext(MirrorFeed::Viewer &viewer, httplib::DataSink &sink, const Faults &faults)
{
  const MirrorFeed::Picture picture = viewer.next(kPatience);
  if (!picture.jpeg) {
    return sink.is_writable();
  }
  const std::string part = partHeader(picture.jpeg->size()) + *picture.jpeg + "\r\n";
  if (!faults.cutCamera) {
    return sink.write(part.data(), part.size());
  }
  sink.write(part.data(), part.size() / 2);
  while (faults.cutCamera && sink.is_writable()) {
    viewer.next(kPatience);
  }
  return false;
}

} // namespace

WebServer::WebServer(const std::string &host, int port, MirrorFeed &feed,
                     std::function<std::string()> truth, Faults &faults)
{
  m_server.new_task_queue = [] { return new httplib::ThreadPool(kClients); }; // it takes ownership
  m_server.set_write_timeout(std::chrono::seconds(5));
  m_server.set_keep_alive_timeout(1);
  m_server.set_tcp_nodelay(true);
  addCamera(feed, faults);
  addFaults(faults);
  m_server.Get("/truth", [truth = std::move(truth)](const httplib::Request &, auto &response) {
    response.set_content(truth(), "application/json");
  });
  m_port = port == 0 ? m_server.bind_to_any_port(host) : port;
  if (m_port <= 0 || (port != 0 && !m_server.bind_to_port(host, port))) {
    throw DeviceError("cannot listen on " + host + ":" + std::to_string(port) +
                      "; choose another port, or 0");
  }
  m_thread = std::jthread([this] { m_server.listen_after_bind(); });
  while (!m_server.is_running()) {
    std::this_thread::yield(); // stop() before it runs would be lost
  }
}

WebServer::~WebServer()
{
  m_server.stop();
}

void WebServer::addCamera(MirrorFeed &feed, const Faults &faults)
{
  m_server.Get(
      "/camera.mjpg", [&feed, &faults](const httplib::Request &, httplib::Response &response) {
        const auto viewer = std::make_shared<MirrorFeed::Viewer>(feed);
        response.set_header("Cache-Control", "no-store");
        response.set_content_provider("multipart/x-mixed-replace; boundary=frame",
                                      [viewer, &faults](std::size_t, httplib::DataSink &sink) {
                                        return sendNext(*viewer, sink, faults);
                                      });
      });
  m_server.Get("/camera.jpg", [&feed](const httplib::Request &, httplib::Response &response) {
    const MirrorFeed::Picture picture = MirrorFeed::Viewer(feed).next(10 * kPatience);
    if (picture.jpeg) {
      response.set_content(*picture.jpeg, "image/jpeg");
    }
    else {
      response.status = 503;
    }
  });
}

void WebServer::addFaults(Faults &faults)
{
  m_server.Post(
      R"(/fault/(\w+))", [&faults](const httplib::Request &request, httplib::Response &response) {
        std::atomic<bool> *fault = faults.find(request.matches[1]);
        const std::string on = request.get_param_value("on");
        if (fault == nullptr || (on != "0" && on != "1")) {
          response.status = 400;
          response.set_content("one of " + Faults::names() + ", and on=0 or on=1\n", "text/plain");
          return;
        }
        *fault = on == "1";
      });
}

} // namespace homeward
