// What a browser gets of a run that goes on, and of the viewer's page, over the network.
#include "apps/viewer/run_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "apps/support/output.h"
#include "tests/support/local_socket.h"
#include "tests/support/temporary_folder.h"

namespace placegraph::apps {
namespace run_view_test {

using nlohmann::json;
using test::answer_of;
using test::content_of;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class RunViewTest : public ::testing::Test {
 protected:
  void SetUp() override {
    testing::internal::CaptureStderr();
    run_view = std::make_unique<RunView>(ViewerOptions{}, "a </title> run", "placegraph 7");
    const std::string told = testing::internal::GetCapturedStderr();
    std::smatch match;
    ASSERT_TRUE(std::regex_search(told, match,
                                  std::regex("http://127.0.0.1:([0-9]+)(/[0-9a-f]{32}/)")));
    port = std::stoi(match[1]);
    root = match[2];
  }
  std::string get(const std::string& path) const { return answer_of(port, "GET " + root + path); }
  std::string control(const std::string& body) const {
    return answer_of(port, "POST " + root + "control", "Content-Type: application/json\r\n", body);
  }
  std::unique_ptr<RunView> run_view;
  int port = 0;
  std::string root;
};

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

// No browser follows the events, so each end returns at once.
TEST_F(RunViewTest, AfterTheRunADamagedMapIsToldApartFromNone) {
  const test::TemporaryFolder dir;
  dir.write("empty/notes.txt", "");
  run_view->finish(dir / "empty", "");
  const std::string none = get("report.json");
  EXPECT_THAT(none, StartsWith("HTTP/1.1 404 "));
  EXPECT_EQ(content_of(none), "the run has no map\n");
  dir.write("damaged/map.db", "no map");
  run_view->finish(dir / "damaged", "");
  const std::string damaged = get("report.json");
  EXPECT_THAT(damaged, StartsWith("HTTP/1.1 500 "));
  EXPECT_THAT(content_of(damaged), HasSubstr("damaged/map.db"));
  EXPECT_EQ(json::parse(content_of(get("live/state.json")))["finished"], true);
}

}  // namespace run_view_test
}  // namespace placegraph::apps
