#include "apps/server/request_check.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <sys/random.h>

#include <algorithm>
#include <array>

namespace placegraph::apps {
namespace {

constexpr std::size_t kLongestTarget = 512;

bool plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '/' ||
         c == '.' || c == '_' || c == '-';
}

/// Compares all characters: the time does not show how many of them agree.
bool same(const std::string& a, const std::string& b) {
  if (a.size() != b.size()) return false;
  unsigned different = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    different |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
  return different == 0;
}

bool own_host(const std::string& host, int port) {
  constexpr int kUsual = 80;  // browsers leave it out
  for (const char* name : {"127.0.0.1", "localhost"})
    if (host == fmt::format("{}:{}", name, port) || (port == kUsual && host == name)) return true;
  return false;
}

}  // namespace

std::string new_token() {
  std::array<unsigned char, 16> bytes{};
  require(getrandom(bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size()),
          "the system gives no random bytes");
  std::string token;
  for (const unsigned char byte : bytes) token += fmt::format("{:02x}", byte);
  return token;
}

std::string address_of(const ServerIdentity& server) {
  return fmt::format("http://127.0.0.1:{}/{}/", server.port, server.token);
}

std::optional<HttpResponse> refusal_of(const HttpRequest& request, const ServerIdentity& server) {
  if (request.method != "GET" && request.method != "POST")
    return text_response(405, "only GET and POST are answered");
  if (request.parts) return text_response(400, "parts are not answered");
  if (request.unknown_length) return text_response(411, "the length of the content is needed");
  if (request.target.size() > kLongestTarget) return text_response(414, "the path is too long");
  if (!std::ranges::all_of(request.target, plain) || request.target.find("..") != std::string::npos)
    return text_response(400, "no such path");
  if (!own_host(request.host, server.port)) return text_response(403, "another host");
  const bool own_origin = request.origin.empty() || request.origin == "http://" + request.host;
  const bool own_site =
      request.site.empty() || request.site == "same-origin" || request.site == "none";
  if (!own_origin || !own_site) return text_response(403, "a request of another page");
  const std::size_t end = server.token.size() + 1;
  if (request.target.size() <= end || request.target[0] != '/' || request.target[end] != '/' ||
      !same(request.target.substr(1, end - 1), server.token))
    return text_response(403, "the address has no valid token");
  if (request.method == "POST" && request.content_type != "application/json")
    return text_response(415, "POST needs JSON");
  return std::nullopt;
}

std::string path_of(const HttpRequest& request, const ServerIdentity& server) {
  return request.target.substr(server.token.size() + 2);
}

}  // namespace placegraph::apps
