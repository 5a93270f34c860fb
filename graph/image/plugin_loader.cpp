#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/image/plugin_loader.h>

#include <filesystem>

namespace placegraph {
namespace {

/// The module in this file; null with a reason in `problem` if it cannot be used.
const void* open_module(const PluginKind& kind, const std::string& file, std::string& problem) {
  void* module = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!module) {
    const char* reason = dlerror();
    problem = fmt::format("cannot be loaded ({}); Debian's packages {} are what it links",
                          reason ? reason : file, kind.packages);
    return nullptr;
  }
  using Version = std::int64_t (*)();
  using Plugin = const void* (*)();
  const auto version = reinterpret_cast<Version>(dlsym(module, kind.version_symbol));
  const auto plugin = reinterpret_cast<Plugin>(dlsym(module, kind.symbol));
  if (version && plugin && version() == kind.version) return plugin();
  problem = version ? fmt::format("is of version {}, and {} is needed", version(), kind.version)
                    : "is no module of placegraph";
  return nullptr;  // it stays mapped: the initialization of its libraries cannot be undone
}

}  // namespace

const void* load_plugin(const PluginKind& kind, const std::vector<std::string>& folders,
                        const std::string& wanted) {
  std::string problem;
  for (const std::string& folder : folders) {
    const std::string file = (std::filesystem::path(folder) / kind.file).string();
    std::error_code error;
    if (!std::filesystem::exists(file, error)) continue;
    std::string reason;
    if (const void* plugin = open_module(kind, file, reason)) return plugin;
    problem += fmt::format("; {} {}", file, reason);
  }
  if (!problem.empty())
    throw FileError(wanted, fmt::format("needs the module {}{}", kind.file, problem));
  throw FileError(
      wanted, fmt::format("needs the module {}, which is in none of the folders {} "
                          "(PLACEGRAPH_PLUGIN_DIR names another); it links Debian's packages {}",
                          kind.file, fmt::join(folders, ", "), kind.packages));
}

const void* load_plugin(const PluginKind& kind, const std::string& wanted) {
  return load_plugin(kind, plugin_folders(), wanted);
}

}  // namespace placegraph
