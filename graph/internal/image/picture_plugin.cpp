#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/internal/image/picture_plugin.h>
#include <placegraph/graph/internal/image/plugin_folders.h>

#include <filesystem>

namespace placegraph {
namespace {

constexpr const char* kPackages =
    "libopencv-imgcodecs406, libopencv-videoio406 and libopencv-contrib406";

/// The module in this file; null with a reason in `problem` if it cannot be used.
const PicturePlugin* open_module(const std::string& file, std::string& problem) {
  void* module = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!module) {
    const char* reason = dlerror();
    problem = fmt::format("cannot be loaded ({}); Debian's packages {} are what it links",
                          reason ? reason : file, kPackages);
    return nullptr;
  }
  using Version = std::int64_t (*)();
  using Plugin = const PicturePlugin* (*)();
  const auto version =
      reinterpret_cast<Version>(dlsym(module, "placegraph_picture_plugin_version"));
  const auto plugin = reinterpret_cast<Plugin>(dlsym(module, "placegraph_picture_plugin"));
  if (version && plugin && version() == kPicturePluginVersion) return plugin();
  problem =
      version ? fmt::format("is of version {}, and {} is needed", version(), kPicturePluginVersion)
              : "is no module of placegraph";
  return nullptr;  // it stays mapped: the initialization of its libraries cannot be undone
}

}  // namespace

const PicturePlugin& load_picture_plugin(const std::vector<std::string>& folders,
                                         const std::string& wanted) {
  std::string problem;
  for (const std::string& folder : folders) {
    const std::string file = (std::filesystem::path(folder) / kPicturePluginFile).string();
    std::error_code error;
    if (!std::filesystem::exists(file, error)) continue;
    std::string reason;
    if (const PicturePlugin* plugin = open_module(file, reason)) return *plugin;
    problem += fmt::format("; {} {}", file, reason);
  }
  if (!problem.empty())
    throw FileError(wanted, fmt::format("needs the module {}{}", kPicturePluginFile, problem));
  throw FileError(
      wanted, fmt::format("needs the module {}, which is in none of the folders {} "
                          "(PLACEGRAPH_PLUGIN_DIR names another); it links Debian's packages {}",
                          kPicturePluginFile, fmt::join(folders, ", "), kPackages));
}

const PicturePlugin& picture_plugin(const std::string& wanted) {
  // A loaded module stays loaded. After a failure the next call tries again.
  static const PicturePlugin& plugin = load_picture_plugin(plugin_folders(), wanted);
  return plugin;
}

}  // namespace placegraph
