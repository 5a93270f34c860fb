// The module libplacegraph_http_plugin.so, see http_server.h. It depends on cpp-httplib alone.
#include <httplib.h>
#include <sys/socket.h>

#include <thread>

#include "apps/server/http_server.h"
#include "apps/server/plugin/bounded_tasks.h"
#include "apps/server/plugin/connections.h"

namespace placegraph::apps {
namespace {

constexpr std::size_t kThreads = 16, kMostPending = 32, kMostBytes = 64 * 1024;
constexpr int kTimeoutS = 5;

HttpRequest request_of(const httplib::Request& from) {
  return {from.method,
          from.target,
          from.get_header_value("Host"),
          from.get_header_value("Origin"),
          from.get_header_value("Sec-Fetch-Site"),
          from.get_header_value("Content-Type"),
          from.has_header("Range"),
          from.has_header("Transfer-Encoding"),
          from.body};
}

void send(const HttpResponse& response, httplib::Response& to) {
  to.status = response.status;
  for (const auto& [name, value] : response.headers) to.set_header(name, value);
  if (!response.stream) {
    to.set_content(response.body, response.type);
    return;
  }
  to.set_chunked_content_provider(
      response.type, [stream = response.stream](std::size_t, httplib::DataSink& sink) {
        const std::optional<std::string> bytes = stream->next();
        if (!bytes) {
          sink.done();
          return true;
        }
        return bytes->empty() || sink.write(bytes->data(), bytes->size());
      });
}

/// One port has one server: SO_REUSEPORT, which the library sets by itself, would allow several.
void set_socket_options(int socket) {
  const int yes = 1;
  setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
}

class LibraryServer : public HttpServer {
 public:
  explicit LibraryServer(HttpHandlers handlers) : handlers_(std::move(handlers)) {
    server_.new_task_queue = [] { return new BoundedTasks(kThreads, kMostPending); };
    server_.set_socket_options(set_socket_options);
    server_.set_tcp_nodelay(true);
    server_.set_payload_max_length(kMostBytes);
    server_.set_read_timeout(kTimeoutS);
    server_.set_write_timeout(kTimeoutS);
    server_.set_pre_routing_handler([this](const auto& request, auto& response) {
      const auto refused = handlers_.refuse(request_of(request));
      if (!refused) return httplib::Server::HandlerResponse::Unhandled;
      send(*refused, response);
      response.set_header("Connection", "close");  // a content that follows is not read
      return httplib::Server::HandlerResponse::Handled;
    });
    const auto respond = [this](const auto& request, auto& response) {
      connections_.begin_response(request.remote_port);
      send(handlers_.respond(request_of(request)), response);
    };
    server_.Get(".*", respond).Post(".*", respond);
    server_.set_logger([this](const auto& request, const auto&) {
      connections_.end_response(request.remote_port);
    });
  }
  ~LibraryServer() override {
    server_.stop();
    connections_.close();  // the server waits for the threads that serve them
    if (thread_.joinable()) thread_.join();
  }
  bool bind(int port) {
    port_ = port;
    if (port == 0)
      port_ = server_.bind_to_any_port("127.0.0.1");
    else if (!server_.bind_to_port("127.0.0.1", port))
      port_ = -1;
    return port_ > 0;
  }
  void start() override {
    thread_ = std::thread([this] { server_.listen_after_bind(); });
    while (!server_.is_running()) std::this_thread::yield();
    connections_.guard(port_);
  }
  int port() const override { return port_; }

 private:
  HttpHandlers handlers_;
  httplib::Server server_;
  Connections connections_;
  std::thread thread_;
  int port_ = 0;
};

struct LibraryModule : HttpModule {
  std::unique_ptr<HttpServer> bind(int port, HttpHandlers handlers) const override {
    auto server = std::make_unique<LibraryServer>(std::move(handlers));
    if (!server->bind(port)) return nullptr;
    return server;
  }
};

}  // namespace
}  // namespace placegraph::apps

extern "C" {
__attribute__((visibility("default"))) std::int64_t placegraph_http_module_version() {
  return placegraph::apps::kHttpModuleVersion;
}
__attribute__((visibility("default"))) const void* placegraph_http_module() {
  static const placegraph::apps::LibraryModule module;
  return static_cast<const placegraph::apps::HttpModule*>(&module);
}
}
