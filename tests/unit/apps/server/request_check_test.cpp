#include <gtest/gtest.h>

#include "apps/server/request_check.h"

namespace placegraph::apps {
namespace request_check_test {

const ServerIdentity kServer{4711, "0123456789abcdef0123456789abcdef"};
const std::string kRoot = "/" + kServer.token + "/";

HttpRequest get(const std::string& path) {
  HttpRequest request;
  request.method = "GET";
  request.target = kRoot + path;
  request.host = "127.0.0.1:4711";
  return request;
}

HttpRequest post(const std::string& path) {
  HttpRequest request = get(path);
  request.method = "POST";
  request.origin = "http://127.0.0.1:4711";
  request.content_type = "application/json";
  return request;
}

/// Status of the refusal; 0: the request is answered.
int status_of(const HttpRequest& request) {
  const auto refused = refusal_of(request, kServer);
  return refused ? refused->status : 0;
}

TEST(RequestCheck, AnswersTheOwnPage) {
  for (const char* path : {"", "report.json", "runs/0/frames/12/image.jpg", "events"}) {
    EXPECT_EQ(status_of(get(path)), 0) << path;
    EXPECT_EQ(path_of(get(path), kServer), path);
  }
  EXPECT_EQ(status_of(post("edits")), 0);
  HttpRequest request = get("");
  request.host = "localhost:4711";
  request.site = "none";
  EXPECT_EQ(status_of(request), 0);
}

TEST(RequestCheck, RefusesOtherMethods) {
  for (const char* method : {"PUT", "DELETE", "OPTIONS", "HEAD", "TRACE", "get", ""}) {
    HttpRequest request = get("report.json");
    request.method = method;
    EXPECT_EQ(status_of(request), 405) << method;
  }
}

TEST(RequestCheck, RefusesAnAddressWithoutTheToken) {
  HttpRequest request = get("");
  for (const std::string& target :
       {std::string("/"), std::string("/report.json"), "/" + kServer.token,
        "/" + std::string(32, '0') + "/", "//" + kServer.token + "/",
        "/" + kServer.token.substr(1) + "/", kServer.token + "/", std::string()}) {
    request.target = target;
    EXPECT_EQ(status_of(request), 403) << target;
  }
}

TEST(RequestCheck, RefusesPathsThatLeaveTheServer) {
  for (const char* path : {"../etc/passwd", "runs/../../x", "%2e%2e/x", "a%00b", "a b", "a?b=c",
                           "a\\b", "a#b", "\xff"})
    EXPECT_EQ(status_of(get(path)), 400) << path;
  EXPECT_EQ(status_of(get(std::string(600, 'a'))), 414);
}

TEST(RequestCheck, RefusesOtherHostsAndPages) {
  for (const char* host : {"", "evil.example", "evil.example:4711", "127.0.0.1", "127.0.0.1:80",
                           "127.0.0.1:4711.evil.example", "[::1]:4711"}) {
    HttpRequest request = get("report.json");
    request.host = host;
    EXPECT_EQ(status_of(request), 403) << host;
  }
  for (const char* origin : {"http://evil.example", "null", "https://127.0.0.1:4711",
                             "http://127.0.0.1:4712", "http://localhost:4711"}) {
    HttpRequest request = post("edits");
    request.origin = origin;
    EXPECT_EQ(status_of(request), 403) << origin;
  }
  for (const char* site : {"cross-site", "same-site"}) {
    HttpRequest request = get("report.json");
    request.site = site;
    EXPECT_EQ(status_of(request), 403) << site;
  }
}

TEST(RequestCheck, RefusesPartsAndContentOfUnknownLength) {
  HttpRequest request = get("report.json");
  request.parts = true;
  EXPECT_EQ(status_of(request), 400);
  request = post("edits");
  request.unknown_length = true;
  EXPECT_EQ(status_of(request), 411);
}

TEST(RequestCheck, RefusesPostsThatAreNoJson) {
  for (const char* type : {"", "text/plain", "application/x-www-form-urlencoded",
                           "multipart/form-data", "application/json;x"}) {
    HttpRequest request = post("edits");
    request.content_type = type;
    EXPECT_EQ(status_of(request), 415) << type;
  }
}

TEST(RequestCheck, ATokenHas32DigitsAndIsNew) {
  const std::string token = new_token();
  EXPECT_EQ(token.size(), 32u);
  EXPECT_EQ(token.find_first_not_of("0123456789abcdef"), std::string::npos);
  EXPECT_NE(token, new_token());
  EXPECT_EQ(address_of({80, "ab"}), "http://127.0.0.1:80/ab/");
}

}  // namespace request_check_test
}  // namespace placegraph::apps
