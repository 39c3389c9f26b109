// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/serve/serve_address.h>

#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace homeward
{

/** Something that a browser gets. */
struct PageFile
{
  std::string path;    ///< "/index.html"
  std::string type;    ///< "text/html; charset=utf-8"
  std::string content; ///< bytes
};

/** What somebody asked for in the browser. */
struct PageCommand
{
  std::string name;      ///< "pause"
  std::string arguments; ///< a JSON object
};

/** What became of it. */
struct PageAnswer
{
  int status = 200;  ///< of HTTP: 200 done, 202 will be done, 409 not now, 400 never
  std::string words; ///< for people, one line
};

/** What a server serves, and to whom. */
struct PageServerOptions
{
  ServeAddress address;                    ///< loopback unless said otherwise
  std::string token;                       ///< that commands need, see newToken()
  std::vector<PageFile> files = {};        ///< that do not change; "/" is a path as any other
  std::set<std::string> withoutToken = {}; ///< commands that everybody at the page may give
  double commandsPerSecond = 10.0;         ///< more are refused
  int patienceSeconds = 5;                 ///< for a whole request, and for a browser to read

  /** Files that come and go, from the server's threads; may be empty. */
  std::function<std::optional<PageFile>(const std::string &path)> find = {};

  /** Called with every command that passed all checks, from the server's threads; may be empty. */
  std::function<PageAnswer(const PageCommand &command)> command = {};
};

/** 128 random bits, 32 hexadecimal digits. */
std::string newToken();

/**
 * Serves a page over HTTP from threads of its own.
 *
 * `GET /events` streams what is published: of each event the newest alone, so that whoever
 * publishes waits for nobody. `POST /command` takes
 * `{"client": "c1", "sequence": 7, "command": "pause", "arguments": {}, "take": false}` with the
 * token in the header `X-Homeward-Token`. Each sequence number of a client counts once. The first
 * client that gives a command commands; another one must `take` that over, and the event
 * `commander` says who it is. Where the address is not of this computer alone, events and files of
 * find() need the token too, as `?token=`.
 *
 * Refused: another Host than the server's, another Origin than the page's, no token (403), what is
 * no JSON (400), more than 4096 bytes (413), a number twice (409), too many commands (429), whoever
 * does not command (423). A request that takes too long is cut off.
 */
class PageServer
{
public:
  /** Listens from now on. @throw ConfigError when the address cannot be had */
  explicit PageServer(PageServerOptions options);
  ~PageServer();
  PageServer(const PageServer &) = delete;
  PageServer &operator=(const PageServer &) = delete;

  /** That it listens on. */
  int port() const;

  /** What to open in a browser, with the token in the fragment, which no browser sends. */
  std::string url() const;

  /**
   * Sends an event to all who look on, and to those who come later.
   * @param event one word
   * @param json one line
   */
  void publish(const std::string &event, const std::string &json);

private:
  class Impl;
  std::unique_ptr<Impl> m_impl;
};

} // namespace homeward
