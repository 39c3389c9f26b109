// SPDX-License-Identifier: GPL-3.0-or-later
#include "raw_client.h"

#include <homeward/core/error.h>
#include <homeward/serve/page_server.h>

#include <gmock/gmock.h>

#include <atomic>
#include <thread>

namespace homeward
{
namespace
{

using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char *kToken = "0123456789abcdef0123456789abcdef";

/** A server that counts what passed its checks. */
class Served : public testing::Test
{
protected:
  Served() : Served("127.0.0.1", 1000.0) {}

  Served(const std::string &host, double commandsPerSecond)
      : server({.address = {host, 0},
                .token = kToken,
                .files = {{"/", "text/html; charset=utf-8", "<p>page</p>"}},
                .withoutToken = {"stop"},
                .commandsPerSecond = commandsPerSecond,
                .patienceSeconds = 1,
                .find = [](const std::string &path) -> std::optional<PageFile> {
                  if (path == "/view/3") {
                    return PageFile{path, "image/jpeg", "jpeg"};
                  }
                  return std::nullopt;
                },
                .command =
                    [this](const PageCommand &command) {
                      ++obeyed;
                      last = command;
                      return PageAnswer{200, "done"};
                    }})
  {}

  std::string here() const { return "127.0.0.1:" + std::to_string(server.port()); }

  /** A request as the page makes it, but for what is said otherwise. */
  std::string post(const std::string &body, const std::string &host, const std::string &origin,
                   const std::string &token) const
  {
    return "POST /command HTTP/1.1\r\nHost: " + host + "\r\n" +
           (origin.empty() ? "" : "Origin: " + origin + "\r\n") +
           (token.empty() ? "" : "X-Homeward-Token: " + token + "\r\n") +
           "Content-Type: application/json\r\nContent-Length: " + std::to_string(body.size()) +
           "\r\n\r\n" + body;
  }

  int command(const std::string &body) const
  {
    return statusOf(server.port(), post(body, here(), "http://" + here(), kToken));
  }

  static std::string order(int sequence, const std::string &name = "go",
                           const std::string &client = "c1", const std::string &more = "")
  {
    return R"({"client":")" + client + R"(","sequence":)" + std::to_string(sequence) +
           R"(,"command":")" + name + "\"" + more + "}";
  }

  int get(const std::string &path, const std::string &more = "") const
  {
    return statusOf(server.port(),
                    "GET " + path + " HTTP/1.1\r\nHost: " + here() + "\r\n" + more + "\r\n");
  }

  std::atomic<int> obeyed{0};
  PageCommand last;
  PageServer server;
};

TEST_F(Served, GivesThePageAndWhatComesAndGoes)
{
  EXPECT_EQ(get("/"), 200);
  EXPECT_EQ(get("/view/3"), 200);
  EXPECT_EQ(get("/view/4"), 404);
  RawClient client(server.port());
  client.send("GET / HTTP/1.1\r\nHost: " + here() + "\r\n\r\n");
  EXPECT_THAT(client.receive("page"), HasSubstr("Content-Security-Policy: default-src 'none'"));
}

TEST_F(Served, ObeysThePage)
{
  EXPECT_EQ(command(order(1, "go", "c1", R"(,"arguments":{"node":3})")), 200);
  EXPECT_EQ(last.name, "go");
  EXPECT_EQ(last.arguments, R"({"node":3})");
  EXPECT_EQ(obeyed, 1);
}

TEST_F(Served, RefusesWhoComesFromElsewhere)
{
  const std::string good = "http://" + here();
  const int port = server.port();
  EXPECT_EQ(statusOf(port, post(order(1), here(), "http://evil.example", kToken)), 403);
  EXPECT_EQ(statusOf(port, post(order(1), here(), "null", kToken)), 403);
  EXPECT_EQ(statusOf(port, post(order(1), here(), "", kToken)), 403);
  EXPECT_EQ(statusOf(port, post(order(1), here(), "https://" + here(), kToken)), 403);
  EXPECT_EQ(statusOf(port, post(order(1), "evil.example", good, kToken)), 403);
  const std::string evil = "evil.example:" + std::to_string(port);
  EXPECT_EQ(statusOf(port, post(order(1), evil, "http://" + evil, kToken)), 403);
  EXPECT_EQ(statusOf(port, post(order(1), "127.0.0.1:1", "http://127.0.0.1:1", kToken)), 403);
  EXPECT_EQ(statusOf(port, "GET / HTTP/1.1\r\nHost: evil.example\r\n\r\n"), 403);
  EXPECT_EQ(statusOf(port, "GET / HTTP/1.1\r\nHost: " + here() + "\r\nHost: evil\r\n\r\n"), 403);
  EXPECT_EQ(statusOf(port, "GET / HTTP/1.0\r\n\r\n"), 403);
  EXPECT_EQ(get("/events", "Origin: http://evil.example\r\n"), 403);
  EXPECT_EQ(get("/view/3", "Origin: http://evil.example\r\n"), 403);
  // A stop needs no token, but the page.
  EXPECT_EQ(statusOf(port, post(order(1, "stop"), here(), "http://evil.example", "")), 403);
  EXPECT_EQ(statusOf(port, post(order(1, "stop"), here(), "", "")), 403);
  EXPECT_EQ(obeyed, 0);
}

TEST_F(Served, ObeysNobodyWithoutTheTokenButAStop)
{
  const std::string good = "http://" + here();
  const int port = server.port();
  EXPECT_EQ(statusOf(port, post(order(1), here(), good, "")), 403);
  EXPECT_EQ(statusOf(port, post(order(1), here(), good, "0123456789abcdef")), 403);
  EXPECT_EQ(statusOf(port, post(order(1), here(), good, std::string(32, '0'))), 403);
  EXPECT_EQ(obeyed, 0);
  EXPECT_EQ(statusOf(port, post(order(1, "stop"), here(), good, "")), 200);
  EXPECT_EQ(last.name, "stop");
}

TEST_F(Served, RefusesWhatIsNoCommand)
{
  EXPECT_EQ(command(""), 400);
  EXPECT_EQ(command("go"), 400);
  EXPECT_EQ(command("[]"), 400);
  EXPECT_EQ(command(std::string(4000, '[')), 400);
  EXPECT_EQ(command(R"({"client":"c1","sequence":1})"), 400);
  EXPECT_EQ(command(R"({"client":1,"sequence":1,"command":"go"})"), 400);
  EXPECT_EQ(command(R"({"client":"c1","sequence":-1,"command":"go"})"), 400);
  EXPECT_EQ(command(R"({"client":"c1","sequence":1e99,"command":"go"})"), 400);
  EXPECT_EQ(command(R"({"client":"../x","sequence":1,"command":"go"})"), 400);
  EXPECT_EQ(command(R"({"client":"c1","sequence":1,"command":"go","arguments":[]})"), 400);
  EXPECT_EQ(command(order(1, std::string(65, 'x'))), 400);
  EXPECT_EQ(command("\xff\xfe{}"), 400);
  EXPECT_EQ(statusOf(server.port(), "nonsense\r\n\r\n"), 400);
  EXPECT_EQ(obeyed, 0);
}

TEST_F(Served, RefusesWhatIsTooLong)
{
  EXPECT_EQ(
      command(order(1, "go", "c1", ",\"arguments\":{\"x\":\"" + std::string(5000, 'x') + "\"}")),
      413);
  const std::string claims = "POST /command HTTP/1.1\r\nHost: " + here() + "\r\nOrigin: http://" +
                             here() + "\r\nContent-Length: 9999999999\r\n\r\n";
  EXPECT_EQ(statusOf(server.port(), claims), 413);
  EXPECT_GE(get("/" + std::string(20000, 'x')), 400);
  EXPECT_NE(get("/", "X-Long: " + std::string(100000, 'x') + "\r\n"), 200);
  EXPECT_EQ(obeyed, 0);
}

TEST_F(Served, ServesNoFilesOfTheDisk)
{
  for (const char *path : {"/../../etc/passwd", "/..%2f..%2fetc/passwd", "/%2e%2e/etc/passwd",
                           "/view/../../etc/passwd", "//etc/passwd", "/etc/passwd"}) {
    EXPECT_GE(get(path), 400) << path;
  }
  EXPECT_GE(statusOf(server.port(),
                     "PUT /x HTTP/1.1\r\nHost: " + here() + "\r\nContent-Length: 1\r\n\r\nx"),
            400);
  EXPECT_GE(statusOf(server.port(), "DELETE / HTTP/1.1\r\nHost: " + here() + "\r\n\r\n"), 400);
}

TEST_F(Served, TakesEveryCommandOnce)
{
  EXPECT_EQ(command(order(7)), 200);
  EXPECT_EQ(command(order(7)), 409);
  EXPECT_EQ(command(order(6)), 409);
  EXPECT_EQ(command(order(8)), 200);
  EXPECT_EQ(obeyed, 2);
}

TEST_F(Served, LetsOneCommand)
{
  EXPECT_EQ(command(order(1, "go", "c1")), 200);
  EXPECT_EQ(command(order(1, "go", "c2")), 423);
  EXPECT_EQ(command(order(2, "stop", "c2")), 200); // everybody may
  EXPECT_EQ(command(order(3, "go", "c2", ",\"take\":true")), 200);
  EXPECT_EQ(command(order(2, "go", "c1")), 423);
  RawClient looker(server.port());
  looker.send("GET /events HTTP/1.1\r\nHost: " + here() + "\r\n\r\n");
  EXPECT_THAT(looker.receive("\"c2\""), HasSubstr("event: commander\ndata: \"c2\""));
}

TEST_F(Served, FreesTheCommandOfWhoLeaves)
{
  {
    RawClient commander(server.port());
    commander.send("GET /events?client=c1 HTTP/1.1\r\nHost: " + here() + "\r\n\r\n");
    commander.receive("text/event-stream");
    EXPECT_EQ(command(order(1, "go", "c1")), 200);
    EXPECT_EQ(command(order(1, "go", "c2")), 423);
  }
  int status = 423;
  for (int i = 2; i < 40 && status == 423; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    status = command(order(i, "go", "c2"));
  }
  EXPECT_EQ(status, 200);
}

TEST_F(Served, CutsOffWhoSendsByteAfterByte)
{
  RawClient slow(server.port());
  ASSERT_TRUE(slow.send("GET / HTTP/1.1\r\n"));
  const auto begin = std::chrono::steady_clock::now();
  while (!slow.closed() && std::chrono::steady_clock::now() - begin < std::chrono::seconds(4)) {
    slow.send("x");
    slow.receive("never", 0.1);
  }
  EXPECT_TRUE(slow.closed());

  RawClient body(server.port());
  body.send("POST /command HTTP/1.1\r\nHost: " + here() + "\r\nOrigin: http://" + here() +
            "\r\nContent-Length: 100\r\n\r\n{");
  body.receive("never", 3.0);
  EXPECT_TRUE(body.closed());
  EXPECT_EQ(get("/"), 200);
  EXPECT_EQ(obeyed, 0);
}

TEST_F(Served, HasRoomAgainWhenHangersAreCutOff)
{
  std::vector<std::unique_ptr<RawClient>> hangers;
  for (int i = 0; i < 50; ++i) {
    hangers.push_back(std::make_unique<RawClient>(server.port()));
    hangers.back()->send("GET / HT");
  }
  EXPECT_EQ(statusOf(server.port(), "GET / HTTP/1.1\r\nHost: " + here() + "\r\n\r\n", 15.0), 200);
}

TEST_F(Served, SendsTheNewestOfEachEventToWhoComesLate)
{
  server.publish("state", "1");
  server.publish("map", "2");
  server.publish("state", "3");
  RawClient looker(server.port());
  looker.send("GET /events HTTP/1.1\r\nHost: " + here() + "\r\n\r\n");
  const std::string text = looker.receive("data: 3");
  EXPECT_THAT(text, HasSubstr("event: map\ndata: 2\n\n"));
  EXPECT_THAT(text, HasSubstr("event: state\ndata: 3\n\n"));
  EXPECT_THAT(text, Not(HasSubstr("data: 1\n")));
  server.publish("state", "4");
  EXPECT_THAT(looker.receive("data: 4"), HasSubstr("event: state\ndata: 4\n\n"));
}

TEST_F(Served, HasRoomForSoManyWhoLookOn)
{
  std::vector<std::unique_ptr<RawClient>> lookers;
  int accepted = 0;
  for (int i = 0; i < 30; ++i) {
    lookers.push_back(std::make_unique<RawClient>(server.port()));
    lookers.back()->send("GET /events HTTP/1.1\r\nHost: " + here() + "\r\n\r\n");
    accepted += lookers.back()->receive("\r\n").rfind("HTTP/1.1 200", 0) == 0 ? 1 : 0;
  }
  EXPECT_EQ(accepted, 24);
  EXPECT_EQ(get("/"), 200); // and commands have room still
  EXPECT_EQ(command(order(1)), 200);
}

TEST_F(Served, WaitsForNobodyWhoDoesNotRead)
{
  std::vector<std::unique_ptr<RawClient>> stalled;
  for (int i = 0; i < 3; ++i) {
    stalled.push_back(std::make_unique<RawClient>(server.port()));
    stalled.back()->send("GET /events HTTP/1.1\r\nHost: " + here() + "\r\n\r\n");
  }
  RawClient reader(server.port());
  reader.send("GET /events HTTP/1.1\r\nHost: " + here() + "\r\n\r\n");
  reader.receive("text/event-stream");
  const std::string much(200000, 'x');
  double longest = 0.0;
  for (int i = 0; i < 100; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    server.publish("view", "\"" + much + "\"");
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    longest = std::max(longest, took.count());
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  server.publish("end", "0");
  EXPECT_LT(longest, 0.1); // a browser that does not read would make it wait for a second
  EXPECT_THAT(reader.receive("event: end"), HasSubstr("event: end"));
}

TEST_F(Served, EndsAtOnceWhoeverLooksOn)
{
  auto brief = std::make_unique<PageServer>(PageServerOptions{.address = {}, .token = kToken});
  RawClient looker(brief->port());
  looker.send("GET /events HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(brief->port()) +
              "\r\n\r\n");
  looker.receive("text/event-stream");
  const auto begin = std::chrono::steady_clock::now();
  brief.reset();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(1));
}

/** One that few may ask. */
class ServedSparingly : public Served
{
protected:
  ServedSparingly() : Served("127.0.0.1", 5.0) {}
};

TEST_F(ServedSparingly, RefusesTooMany)
{
  int refused = 0;
  for (int i = 0; i < 30; ++i) {
    refused += command(order(i)) == 429 ? 1 : 0;
  }
  EXPECT_GT(refused, 15);
  EXPECT_EQ(command(order(100, "stop")), 200); // never too often
}

/** One that other computers can come to. */
class ServedToAll : public Served
{
protected:
  ServedToAll() : Served("0.0.0.0", 1000.0) {}
};

TEST_F(ServedToAll, ShowsNothingWithoutTheToken)
{
  EXPECT_EQ(get("/"), 200); // the bare page
  EXPECT_EQ(get("/events"), 403);
  EXPECT_EQ(get("/view/3"), 403);
  EXPECT_EQ(get(std::string("/view/3?token=") + kToken), 200);
  EXPECT_EQ(get(std::string("/events?token=") + kToken), 200);
  EXPECT_EQ(statusOf(server.port(), "GET / HTTP/1.1\r\nHost: evil.example:" +
                                        std::to_string(server.port()) + "\r\n\r\n"),
            403);
}

TEST(PageServer, SaysWhichAddressItCannotHave)
{
  const PageServer first({.address = {}, .token = kToken});
  EXPECT_THAT(first.url(), HasSubstr(std::string("/#token=") + kToken));
  try {
    const PageServer second({.address = {"127.0.0.1", first.port()}, .token = kToken});
    FAIL();
  }
  catch (const ConfigError &error) {
    EXPECT_THAT(error.what(), HasSubstr(std::to_string(first.port())));
  }
}

TEST(ServeAddress, IsReadWithAndWithoutHost)
{
  EXPECT_EQ(parseServeAddress("8080").host, "127.0.0.1");
  EXPECT_EQ(parseServeAddress("8080").port, 8080);
  EXPECT_EQ(parseServeAddress("192.168.1.5:80").host, "192.168.1.5");
  EXPECT_EQ(parseServeAddress("[::1]:8080").host, "::1");
  EXPECT_TRUE(parseServeAddress("localhost:1").loopback());
  EXPECT_FALSE(parseServeAddress("0.0.0.0:1").loopback());
  for (const char *wrong : {"", "x", "1:", ":8080", "70000", "-1", "80 80", "h:80x"}) {
    EXPECT_THROW(parseServeAddress(wrong), ConfigError) << wrong;
  }
}

TEST(NewToken, IsAnotherOneEachTime)
{
  EXPECT_EQ(newToken().size(), 32U);
  EXPECT_NE(newToken(), newToken());
}

} // namespace
} // namespace homeward
