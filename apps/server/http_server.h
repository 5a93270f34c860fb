#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace placegraph::apps {

/// A request as it came; header fields that were not sent are empty.
struct HttpRequest {
  std::string method;        ///< "GET", "POST", ...
  std::string target;        ///< path as it was sent, not decoded, with the query
  std::string host, origin;  ///< header fields Host and Origin
  std::string site;          ///< header field Sec-Fetch-Site
  std::string content_type;  ///< header field Content-Type
  /// Whether header fields ask for parts (Range) or announce content of unknown length
  /// (Transfer-Encoding).
  bool parts = false, unknown_length = false;
  std::string body;  ///< content; empty while only the head of the request is judged
};

/// Content that grows while it is sent.
class HttpStream {
 public:
  virtual ~HttpStream() = default;
  /// Waits for the next bytes; nothing at the end. Must return within some seconds.
  virtual std::optional<std::string> next() = 0;
};

struct HttpResponse {
  int status = 200;
  std::string type = "text/plain; charset=utf-8";  ///< content type
  std::string body;
  std::shared_ptr<HttpStream> stream = nullptr;  ///< in place of `body`
  std::vector<std::pair<std::string, std::string>> headers = {};
};

/// A sentence as an answer.
HttpResponse text_response(int status, const std::string& sentence);

/// What a server does; called on several threads at once.
struct HttpHandlers {
  /// The answer that refuses a request by its head alone, or nothing.
  std::function<std::optional<HttpResponse>(const HttpRequest&)> refuse;
  /// The answer to a request that was not refused.
  std::function<HttpResponse(const HttpRequest&)> respond;
};

/// A server on 127.0.0.1, which ends with the object.
class HttpServer {
 public:
  virtual ~HttpServer() = default;
  virtual int port() const = 0;
  /// Begins to answer requests, on threads of its own.
  virtual void start() = 0;
};

/// Interface of the module libplacegraph_http_plugin.so, which alone links the library for HTTP:
/// that brings OpenSSL with it. No function throws.
struct HttpModule {
  virtual ~HttpModule() = default;
  /// Takes a port, or a free one for 0; null if it is not free. The server waits for its streams
  /// when it ends: they must end first.
  virtual std::unique_ptr<HttpServer> bind(int port, HttpHandlers handlers) const = 0;
};

/// Version of the declarations above; it changes with each of their changes.
constexpr std::int64_t kHttpModuleVersion = 2;

/// A server for a port, or for a free one for 0; it must be started.
///
/// Throws Error if the port is not free, FileError if the module cannot be loaded.
std::unique_ptr<HttpServer> bind_http(int port, HttpHandlers handlers);

}  // namespace placegraph::apps
