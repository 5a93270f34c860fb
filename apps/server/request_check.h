#pragma once
#include <optional>
#include <string>

#include "apps/server/http_server.h"

namespace placegraph::apps {

/// By what a server knows requests of its own page.
///
/// The token is the first part of every path: another program or web page cannot guess it.
struct ServerIdentity {
  int port = 0;
  std::string token;  ///< 32 hexadecimal digits
};

/// A new token, of 128 random bits of the system.
std::string new_token();

/// Address of the page: "http://127.0.0.1:PORT/TOKEN/".
std::string address_of(const ServerIdentity& server);

/// The answer that refuses a request, or nothing if it may be answered.
///
/// Refused are: methods other than GET and POST; targets that are long or have other characters
/// than letters, digits and "/._-", or ".."; another host than the server's own, under which a
/// foreign name would resolve to it; requests of other origins; paths without the token; and POST
/// without JSON.
std::optional<HttpResponse> refusal_of(const HttpRequest& request, const ServerIdentity& server);

/// The path behind "/TOKEN/" of a request that is not refused.
std::string path_of(const HttpRequest& request, const ServerIdentity& server);

}  // namespace placegraph::apps
