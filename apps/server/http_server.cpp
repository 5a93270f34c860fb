#include "apps/server/http_server.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/internal/image/plugin_folders.h>

#include <filesystem>

namespace placegraph::apps {
namespace {

constexpr const char* kFile = "libplacegraph_http_plugin.so";

const HttpModule* open_module(const std::string& file, std::string& problem) {
  void* module = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!module) {
    const char* reason = dlerror();
    problem = fmt::format("{} cannot be loaded ({})", file, reason ? reason : "no reason given");
    return nullptr;
  }
  using Version = std::int64_t (*)();
  using Module = const HttpModule* (*)();
  const auto version = reinterpret_cast<Version>(dlsym(module, "placegraph_http_module_version"));
  const auto get = reinterpret_cast<Module>(dlsym(module, "placegraph_http_module"));
  if (version && get && version() == kHttpModuleVersion) return get();
  problem = file + " belongs to another version of placegraph";
  return nullptr;
}

const HttpModule& load_http_module() {
  const std::vector<std::string> folders = plugin_folders();
  std::string problem = fmt::format("it is in none of the folders {}", fmt::join(folders, ", "));
  for (const std::string& folder : folders) {
    const std::string file = (std::filesystem::path(folder) / kFile).string();
    std::error_code error;
    if (!std::filesystem::exists(file, error)) continue;
    if (const HttpModule* module = open_module(file, problem)) return *module;
  }
  throw FileError(kFile, fmt::format("the viewer needs this module: {}; it links Debian's package "
                                     "libcpp-httplib0.11",
                                     problem));
}

}  // namespace

HttpResponse text_response(int status, const std::string& sentence) {
  HttpResponse response;
  response.status = status;
  response.body = sentence + "\n";
  return response;
}

std::unique_ptr<HttpServer> bind_http(int port, HttpHandlers handlers) {
  static const HttpModule& module = load_http_module();
  auto server = module.bind(port, std::move(handlers));
  if (!server)
    throw Error(port == 0 ? std::string("no free port on 127.0.0.1")
                          : fmt::format("--port {}: it is in use or not allowed", port));
  return server;
}

}  // namespace placegraph::apps
