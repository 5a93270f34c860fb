// What a browser gets of a run that goes on, and of the viewer's page, over the network.
#include "apps/viewer/run_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "apps/support/output.h"
#include "tests/support/local_socket.h"

namespace placegraph::apps {
namespace run_view_test {

using nlohmann::json;
using test::answer_of;
using test::content_of;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// The view of a run, one for all tests: each would wait for the end of its own.
class RunViewTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    std::string told;
    set_message_sink([&](LogLevel, const std::string& message) { told += message; });
    run_view = std::make_unique<RunView>(ViewerOptions{}, "a </title> run", "placegraph 7");
    set_message_sink({});
    std::smatch match;
    ASSERT_TRUE(std::regex_search(told, match,
                                  std::regex("http://127.0.0.1:([0-9]+)(/[0-9a-f]{32}/)")));
    port = std::stoi(match[1]);
    root = match[2];
  }
  static void TearDownTestSuite() { run_view.reset(); }
  static std::string get(const std::string& path) { return answer_of(port, "GET " + root + path); }
  static std::string control(const std::string& body) {
    return answer_of(port, "POST " + root + "control", "Content-Type: application/json\r\n", body);
  }
  static std::unique_ptr<RunView> run_view;
  static int port;
  static std::string root;
};
std::unique_ptr<RunView> RunViewTest::run_view;
int RunViewTest::port = 0;
std::string RunViewTest::root;

TEST_F(RunViewTest, ThePageRunsOnlyTheScriptsOfItsAnswer) {
  std::set<std::string> nonces;
  for (int i = 0; i < 2; ++i) {
    const std::string answer = get("");
    std::smatch policy;
    ASSERT_TRUE(std::regex_search(answer, policy, std::regex("script-src 'nonce-([0-9a-f]+)'")));
    nonces.insert(policy[1]);
    EXPECT_THAT(content_of(answer), AllOf(HasSubstr("nonce=\"" + policy[1].str() + "\""),
                                          HasSubstr("\"title\":\"a \\u003c/title> run\""),
                                          Not(HasSubstr("placegraph-nonce"))));
  }
  EXPECT_EQ(nonces.size(), 2U);
}

TEST_F(RunViewTest, EveryAnswerForbidsToKeepAndToEmbedIt) {
  for (const std::string& answer : {get(""), get("live/state.json"), get("none"), get("a?b"),
                                    answer_of(port, "GET /"), control("{}")})
    EXPECT_THAT(answer, AllOf(HasSubstr("\r\nCache-Control: no-store\r\n"),
                              HasSubstr("\r\nX-Content-Type-Options: nosniff\r\n"),
                              HasSubstr("\r\nX-Frame-Options: DENY\r\n"),
                              HasSubstr("\r\nCross-Origin-Resource-Policy: same-origin\r\n")));
  EXPECT_THAT(answer_of(port, "GET /"), StartsWith("HTTP/1.1 403 "));
}

TEST_F(RunViewTest, ThePageControlsTheRun) {
  const json paused = {{"paused", true}}, going = {{"paused", false}};
  EXPECT_EQ(json::parse(content_of(control(R"({"action": "pause"})"))), paused);
  EXPECT_EQ(json::parse(content_of(get("live/state.json")))["paused"], true);
  EXPECT_EQ(json::parse(content_of(control(R"({"action": "step"})"))), paused);
  int asked = 0;
  run_view->watcher().await_permission([&] { return ++asked > 0; });
  EXPECT_EQ(asked, 0);  // the step
  EXPECT_EQ(json::parse(content_of(control(R"({"action": "resume"})"))), going);
  for (const char* body : {"{", "[]", "{}", R"({"action": 1})", R"({"action": "end"})"})
    EXPECT_THAT(control(body), StartsWith("HTTP/1.1 400 ")) << body;
  EXPECT_THAT(answer_of(port, "POST " + root + "edits", "Content-Type: application/json\r\n", "{}"),
              StartsWith("HTTP/1.1 405 "));
}

TEST_F(RunViewTest, WhatIsNotThereYetIsSaid) {
  EXPECT_THAT(get("live/image.json"), StartsWith("HTTP/1.1 204 "));
  EXPECT_THAT(get("report.json"), StartsWith("HTTP/1.1 404 "));
  const json state = json::parse(content_of(get("live/state.json")));
  EXPECT_EQ(state["finished"], false);
  EXPECT_EQ(state["done"], 0);
}

}  // namespace run_view_test
}  // namespace placegraph::apps
