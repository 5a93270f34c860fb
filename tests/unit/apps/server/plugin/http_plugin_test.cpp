// The server of the module, through the interface by which the program loads it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>

#include <mutex>

#include "apps/server/http_server.h"
#include "tests/support/local_socket.h"
#include "tests/support/message_of.h"

namespace placegraph::apps {
namespace http_plugin_test {

using test::answer_of;
using test::content_of;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// Some texts in turn.
class Texts : public HttpStream {
 public:
  explicit Texts(std::vector<std::string> texts) : texts_(std::move(texts)) {}
  std::optional<std::string> next() override {
    if (next_ == texts_.size()) return std::nullopt;
    return texts_[next_++];
  }

 private:
  std::vector<std::string> texts_;
  std::size_t next_ = 0;
};

/// One server for all tests: each would wait for the end of its own.
class HttpPlugin : public ::testing::Test {
 protected:
  struct Seen {
    std::mutex mutex;
    std::vector<HttpRequest> judged, answered;
  };

  static void SetUpTestSuite() {
    seen = std::make_unique<Seen>();
    HttpHandlers handlers;
    handlers.refuse = [](const HttpRequest& request) -> std::optional<HttpResponse> {
      const std::lock_guard lock(seen->mutex);
      seen->judged.push_back(request);
      if (request.target != "/secret") return std::nullopt;
      return text_response(403, "not for you");
    };
    handlers.respond = [](const HttpRequest& request) {
      {
        const std::lock_guard lock(seen->mutex);
        seen->answered.push_back(request);
      }
      return respond(request.target);
    };
    server = bind_http(0, std::move(handlers));
    server->start();
  }
  static HttpResponse respond(const std::string& target) {
    HttpResponse response;
    response.body = "something";
    if (target == "/page") {
      response = {201, "text/html", std::string("<p>\0</p>", 8)};
      response.headers = {{"X-One", "1"}, {"X-Two", "2"}};
    }
    if (target == "/stream") {
      response.type = "text/event-stream";
      response.stream =
          std::make_shared<Texts>(std::vector<std::string>{"one,", "", std::string(20, 'x')});
    }
    return response;
  }
  static void TearDownTestSuite() {
    server.reset();
    seen.reset();
  }
  void SetUp() override {
    const std::lock_guard lock(seen->mutex);
    seen->judged.clear();
    seen->answered.clear();
  }

  static std::unique_ptr<HttpServer> server;
  static std::unique_ptr<Seen> seen;
};
std::unique_ptr<HttpServer> HttpPlugin::server;
std::unique_ptr<HttpPlugin::Seen> HttpPlugin::seen;

TEST_F(HttpPlugin, APortHasOneServer) {
  EXPECT_EQ(test::message_of<Error>([] { (void)bind_http(server->port(), {}); }),
            "--port " + std::to_string(server->port()) + ": it is in use or not allowed");
  const std::unique_ptr<HttpServer> other = bind_http(0, {});
  EXPECT_NE(other->port(), server->port());
}

TEST_F(HttpPlugin, APortIsFreeAgainAfterItsServerWhateverWasConnected) {
  HttpHandlers handlers;
  handlers.refuse = [](const HttpRequest&) { return std::nullopt; };
  handlers.respond = [](const HttpRequest&) { return text_response(200, "here"); };
  std::unique_ptr<HttpServer> own = bind_http(0, std::move(handlers));
  const int port = own->port();
  own->start();
  const test::LocalSocket silent = test::LocalSocket::connected(port);
  EXPECT_EQ(content_of(answer_of(port, "GET /")), "here\n");
  own.reset();
  EXPECT_EQ(silent.receive(), "");
  EXPECT_EQ(bind_http(port, {})->port(), port);
}

TEST_F(HttpPlugin, HandlersGetTheRequestAsItWasSent) {
  EXPECT_THAT(answer_of(server->port(), "POST /a/b.c?d=%20e",
                        "Origin: http://a.b\r\nSec-Fetch-Site: same-origin\r\n"
                        "Content-Type: application/json\r\n",
                        "{\"x\": 1}"),
              StartsWith("HTTP/1.1 200 "));
  ASSERT_EQ(seen->judged.size(), 1U);
  ASSERT_EQ(seen->answered.size(), 1U);
  EXPECT_EQ(seen->judged[0].body, "");  // the head alone is judged
  EXPECT_EQ(seen->answered[0].body, "{\"x\": 1}");
  for (const HttpRequest& request : {seen->judged[0], seen->answered[0]}) {
    EXPECT_EQ(request.method, "POST");
    EXPECT_EQ(request.target, "/a/b.c?d=%20e");
    EXPECT_EQ(request.host, "127.0.0.1:" + std::to_string(server->port()));
    EXPECT_EQ(request.origin, "http://a.b");
    EXPECT_EQ(request.site, "same-origin");
    EXPECT_EQ(request.content_type, "application/json");
    EXPECT_FALSE(request.parts || request.unknown_length);
  }
}

TEST_F(HttpPlugin, PartsAndUnknownLengthsAreTold) {
  (void)answer_of(server->port(), "GET /secret", "Range: bytes=0-1\r\n");
  (void)answer_of(server->port(), "POST /secret", "Transfer-Encoding: chunked\r\n");
  ASSERT_EQ(seen->judged.size(), 2U);
  EXPECT_TRUE(seen->judged[0].parts && !seen->judged[0].unknown_length);
  EXPECT_TRUE(seen->judged[1].unknown_length && !seen->judged[1].parts);
  EXPECT_EQ(seen->judged[0].origin, "");  // what was not sent
}

TEST_F(HttpPlugin, ARefusedRequestIsNotAnswered) {
  const std::string answer = answer_of(server->port(), "GET /secret");
  EXPECT_THAT(answer, AllOf(StartsWith("HTTP/1.1 403 "), HasSubstr("Connection: close")));
  EXPECT_EQ(content_of(answer), "not for you\n");
  EXPECT_TRUE(seen->answered.empty());
}

TEST_F(HttpPlugin, AnAnswerHasItsStatusTypeHeadersAndBytes) {
  const std::string answer = answer_of(server->port(), "GET /page");
  EXPECT_THAT(answer, AllOf(StartsWith("HTTP/1.1 201 "), HasSubstr("\r\nContent-Type: text/html\r"),
                            HasSubstr("\r\nX-One: 1\r\n"), HasSubstr("\r\nX-Two: 2\r\n"),
                            HasSubstr("\r\nContent-Length: 8\r\n")));
  EXPECT_EQ(content_of(answer), std::string("<p>\0</p>", 8));
}

// Chunks of HTTP: the length in hexadecimal digits, the bytes; at the end one without bytes.
TEST_F(HttpPlugin, AStreamIsSentPieceByPieceUntilItEnds) {
  const std::string answer = answer_of(server->port(), "GET /stream");
  EXPECT_THAT(answer, AllOf(HasSubstr("\r\nContent-Type: text/event-stream\r\n"),
                            Not(HasSubstr("Content-Length"))));
  EXPECT_EQ(content_of(answer),
            "4\r\none,\r\n14\r\n" + std::string(20, 'x') + "\r\n0\r\n\r\n");
}

TEST_F(HttpPlugin, AContentThatIsTooLongIsNotTaken) {
  EXPECT_THAT(answer_of(server->port(), "POST /a", "", std::string(64 * 1024 + 1, ' ')),
              Not(StartsWith("HTTP/1.1 200 ")));
  EXPECT_TRUE(seen->answered.empty());
  EXPECT_THAT(answer_of(server->port(), "POST /a", "", std::string(64 * 1024, ' ')),
              StartsWith("HTTP/1.1 200 "));
  ASSERT_EQ(seen->answered.size(), 1U);
  EXPECT_EQ(seen->answered[0].body.size(), 64U * 1024);
}

}  // namespace http_plugin_test
}  // namespace placegraph::apps
