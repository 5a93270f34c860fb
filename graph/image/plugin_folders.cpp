#include <dlfcn.h>
#include <link.h>
#include <placegraph/graph/image/plugin_folders.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

namespace placegraph {
namespace fs = std::filesystem;
namespace {

/// The program or shared library that contains this code; empty if the system does not report it.
fs::path file_of_this_code() {
  std::error_code error;
  Dl_info info{};
  void* extra = nullptr;
  fs::path file = "/proc/self/exe";  // the program has no name in the list of loaded files
  if (dladdr1(reinterpret_cast<const void*>(&plugin_folders), &info, &extra, RTLD_DL_LINKMAP)) {
    const auto* loaded = static_cast<const link_map*>(extra);
    if (loaded && loaded->l_name && *loaded->l_name) file = loaded->l_name;
  }
  fs::path found = fs::canonical(file, error);
  return error ? fs::path() : found;
}

bool is_inside(const fs::path& file, const fs::path& folder) {
  return std::ranges::mismatch(folder, file).in1 == folder.end();
}

}  // namespace

std::vector<std::string> plugin_folders() {
  std::vector<std::string> folders;
  const auto add = [&](const fs::path& folder) {
    const std::string path = folder.lexically_normal().string();
    if (std::ranges::find(folders, path) == folders.end()) folders.push_back(path);
  };
  if (const char* given = std::getenv("PLACEGRAPH_PLUGIN_DIR"); given && *given) add(given);
  if (const fs::path file = file_of_this_code(); !file.empty()) {
    std::error_code error;
    const fs::path build = fs::canonical(PLACEGRAPH_BUILD_DIR, error);
    if (!error && is_inside(file, build)) add(build / "lib" / "placegraph");
    add(file.parent_path().parent_path() / PLACEGRAPH_LIBDIR / "placegraph");
    add(file.parent_path() / "placegraph");
  }
  add(fs::path(PLACEGRAPH_FULL_LIBDIR) / "placegraph");
  return folders;
}

}  // namespace placegraph
