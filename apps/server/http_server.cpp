#include "apps/server/http_server.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/image/plugin_loader.h>

namespace placegraph::apps {
namespace {

constexpr PluginKind kKind = {"libplacegraph_http_plugin.so", "placegraph_http_module_version",
                              "placegraph_http_module", kHttpModuleVersion, "libcpp-httplib0.11"};

}  // namespace

HttpResponse text_response(int status, const std::string& sentence) {
  HttpResponse response;
  response.status = status;
  response.body = sentence + "\n";
  return response;
}

std::unique_ptr<HttpServer> bind_http(int port, HttpHandlers handlers) {
  static const auto& module = *static_cast<const HttpModule*>(load_plugin(kKind, "the viewer"));
  auto server = module.bind(port, std::move(handlers));
  if (!server)
    throw Error(port == 0 ? std::string("no free port on 127.0.0.1")
                          : fmt::format("--port {}: it is in use or not allowed", port));
  return server;
}

}  // namespace placegraph::apps
