// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/serve/page_server.h>

#include "event_board.h"
#include "gate.h"
#include "socket_stream.h"

#include <homeward/core/error.h>

#include <nlohmann/json.hpp>

#include <atomic>
#include <deque>
#include <random>
#include <thread>

#include <sys/socket.h>
#include <unistd.h>

namespace homeward
{
namespace
{

constexpr std::size_t kThreads = 40;              // connections at a time
constexpr std::size_t kWaiting = 16;              // connections that wait for a thread
constexpr int kStreams = 24;                      // of events
constexpr int kRequests = 100;                    // on one connection
constexpr std::size_t kMostBytes = 4096;          // of a command
constexpr std::chrono::milliseconds kPulse{1000}; // after which a browser that left is noticed

// Everything from this server, no frames, no scripts in the page itself.
constexpr const char *kPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/** Threads that take connections; when all are busy the next ones wait outside. */
class Threads final : public httplib::TaskQueue
{
public:
  Threads()
  {
    for (std::size_t i = 0; i < kThreads; ++i) {
      m_threads.emplace_back([this] { work(); });
    }
  }

  void enqueue(std::function<void()> task) override
  {
    std::unique_lock lock(m_mutex);
    m_changed.wait(lock, [this] { return m_tasks.size() < kWaiting || m_over; });
    m_tasks.push_back(std::move(task));
    lock.unlock();
    m_changed.notify_all();
  }

  void shutdown() override
  {
    {
      const std::lock_guard lock(m_mutex);
      m_over = true;
    }
    m_changed.notify_all();
    m_threads.clear(); // joins
  }

private:
  void work()
  {
    std::unique_lock lock(m_mutex);
    while (true) {
      m_changed.wait(lock, [this] { return !m_tasks.empty() || m_over; });
      if (m_tasks.empty()) {
        return;
      }
      const std::function<void()> task = std::move(m_tasks.front());
      m_tasks.pop_front();
      lock.unlock();
      m_changed.notify_all();
      task();
      lock.lock();
    }
  }

  std::mutex m_mutex;
  std::condition_variable m_changed;
  std::deque<std::function<void()>> m_tasks;
  bool m_over = false;
  std::vector<std::jthread> m_threads;
};

/** cpp-httplib's server on streams of ours, all of which can be cut. */
class CuttingServer final : public httplib::Server
{
public:
  explicit CuttingServer(std::chrono::seconds patience) : m_patience(patience) {}

  /** Of all connections there are and will be. */
  void cut()
  {
    const std::lock_guard lock(m_mutex);
    m_cut = true;
    for (const int socket : m_sockets) {
      ::shutdown(socket, SHUT_RDWR);
    }
  }

private:
  bool process_and_close_socket(socket_t socket) override
  {
    if (enter(socket)) {
      SocketStream stream(socket, m_patience);
      bool closed = false;
      for (int i = 1; i <= kRequests && !closed && stream.awaitRequest(); ++i) {
        if (!process_request(stream, i == kRequests, closed, nullptr)) {
          break;
        }
      }
    }
    leave(socket);
    return true;
  }

  bool enter(int socket)
  {
    const std::lock_guard lock(m_mutex);
    m_sockets.insert(socket);
    return !m_cut;
  }

  /** Closed under the mutex, lest its number already be somebody else's when it is cut. */
  void leave(int socket)
  {
    const std::lock_guard lock(m_mutex);
    ::shutdown(socket, SHUT_RDWR);
    ::close(socket);
    m_sockets.erase(socket);
  }

  std::chrono::seconds m_patience;
  std::mutex m_mutex;
  std::set<int> m_sockets;
  bool m_cut = false;
};

void answer(httplib::Response &response, const PageAnswer &what)
{
  response.status = what.status;
  response.set_content(nlohmann::json{{"words", what.words}}.dump(), "application/json");
}

Visitor visitorOf(const httplib::Request &request)
{
  Visitor visitor{request.get_header_value("Host"), request.get_header_value("Origin"),
                  request.get_header_value("X-Homeward-Token")};
  if (request.get_header_value_count("Host") != 1 || request.get_header_value_count("Origin") > 1) {
    visitor.host.clear();
  }
  if (visitor.token.empty()) {
    visitor.token = request.get_param_value("token");
  }
  return visitor;
}

} // namespace

class PageServer::Impl
{
public:
  explicit Impl(PageServerOptions options)
      : m_options(std::move(options)), m_server(std::chrono::seconds(m_options.patienceSeconds))
  {
    const std::string &host = m_options.address.host;
    const int wanted = m_options.address.port;
    m_server.new_task_queue = [] { return new Threads; }; // it takes ownership
    m_server.set_payload_max_length(kMostBytes);
    m_server.set_tcp_nodelay(true);
    m_server.set_socket_options([](int socket) { // a port that another server has is not free
      const int yes = 1;
      setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    m_port = wanted == 0 ? m_server.bind_to_any_port(host) : wanted;
    if (m_port <= 0 || (wanted != 0 && !m_server.bind_to_port(host, wanted))) {
      throw ConfigError("cannot listen on " + host + ":" + std::to_string(wanted) +
                        "; choose another port, or 0");
    }
    m_gate.emplace(m_options, m_port);
    addHandlers();
    m_thread = std::jthread([this] { m_server.listen_after_bind(); });
    while (!m_server.is_running()) {
      std::this_thread::yield(); // stop() before it runs would be lost
    }
  }

  ~Impl()
  {
    m_board.close();
    m_server.stop();
    m_server.cut();
  }

  Impl(const Impl &) = delete;
  Impl &operator=(const Impl &) = delete;

  int port() const { return m_port; }

  std::string url() const
  {
    const bool any = m_options.address.host == "0.0.0.0" || m_options.address.host == "::";
    const std::string host = any ? "127.0.0.1" : m_options.address.host;
    const bool brackets = host.find(':') != std::string::npos;
    return "http://" + (brackets ? "[" + host + "]" : host) + ":" + std::to_string(m_port) +
           "/#token=" + m_options.token;
  }

  EventBoard &board() { return m_board; }

private:
  void addHandlers()
  {
    m_server.set_default_headers({{"Content-Security-Policy", kPolicy},
                                  {"X-Content-Type-Options", "nosniff"},
                                  {"Referrer-Policy", "no-referrer"},
                                  {"Cache-Control", "no-store"}});
    for (const PageFile &file : m_options.files) {
      m_server.Get(file.path, [this, &file](const auto &request, auto &response) {
        if (!refused(request, response, false)) {
          response.set_content(file.content, file.type.c_str());
        }
      });
    }
    m_server.Get("/events", [this](const auto &request, auto &response) {
      if (!refused(request, response, true)) {
        stream(request.get_param_value("client"), response);
      }
    });
    m_server.Get("/.+", [this](const auto &request, auto &response) {
      if (!refused(request, response, true)) {
        find(request.path, response);
      }
    });
    m_server.Post("/command", [this](const auto &request, auto &response) {
      try {
        answer(response, obey(visitorOf(request), parseOrder(request.body)));
      }
      catch (const PageAnswer &refusal) {
        answer(response, refusal);
      }
    });
  }

  bool refused(const httplib::Request &request, httplib::Response &response, bool guarded) const
  {
    const std::optional<PageAnswer> refusal = m_gate->refuseGet(visitorOf(request), guarded);
    if (refusal) {
      answer(response, *refusal);
    }
    return refusal.has_value();
  }

  void find(const std::string &path, httplib::Response &response) const
  {
    const std::optional<PageFile> file =
        m_options.find ? m_options.find(path) : std::optional<PageFile>();
    if (file) {
      response.set_content(file->content, file->type.c_str());
    }
    else {
      answer(response, {404, "there is no such page"});
    }
  }

  PageAnswer obey(const Visitor &visitor, const Order &order)
  {
    if (const auto refusal = m_gate->refuseOrder(visitor, order, Gate::Clock::now())) {
      return *refusal;
    }
    announce();
    return m_options.command ? m_options.command(order.command)
                             : PageAnswer{409, "nothing can be done here"};
  }

  /** Says who commands. */
  void announce() { m_board.put("commander", nlohmann::json(m_gate->commander()).dump()); }

  void stream(const std::string &client, httplib::Response &response)
  {
    if (++m_streams > kStreams) {
      --m_streams;
      answer(response, {503, "too many look on"});
      return;
    }
    const auto seen = std::make_shared<std::uint64_t>(0);
    response.set_chunked_content_provider(
        "text/event-stream",
        [this, seen](std::size_t, httplib::DataSink &sink) { return sendNext(*seen, sink); },
        [this, client](bool) {
          --m_streams;
          if (m_gate->leave(client)) {
            announce();
          }
        });
  }

  bool sendNext(std::uint64_t &seen, httplib::DataSink &sink)
  {
    const std::vector<EventBoard::Text> texts = m_board.take(seen, kPulse);
    if (m_board.closed() || !sink.is_writable()) {
      return false;
    }
    for (const EventBoard::Text &text : texts) {
      if (!sink.write(text->data(), text->size())) {
        return false;
      }
    }
    return !texts.empty() || sink.write(":\n\n", 3);
  }

  PageServerOptions m_options;
  CuttingServer m_server;
  int m_port = 0;
  std::optional<Gate> m_gate;
  EventBoard m_board;
  std::atomic<int> m_streams{0};
  std::jthread m_thread; ///< last: it uses all of the above
};

std::string newToken()
{
  std::random_device random;
  std::string token;
  for (int i = 0; i < 32; ++i) {
    token += "0123456789abcdef"[random() % 16];
  }
  return token;
}

PageServer::PageServer(PageServerOptions options)
    : m_impl(std::make_unique<Impl>(std::move(options)))
{}

PageServer::~PageServer() = default;

int PageServer::port() const
{
  return m_impl->port();
}

std::string PageServer::url() const
{
  return m_impl->url();
}

void PageServer::publish(const std::string &event, const std::string &json)
{
  m_impl->board().put(event, json);
}

} // namespace homeward
