#include "apps/shipped/shipped_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/text/spelling.h>

#include <algorithm>
#include <filesystem>

namespace placegraph::apps {
namespace fs = std::filesystem;
namespace {

std::vector<std::string> shipped_configs() {
  std::vector<std::string> names;
  for (const std::string& folder : shipped_folders("configs")) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error))
      if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  }
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

}  // namespace

std::vector<std::string> shipped_folders(const std::string& kind) {
  std::vector<std::string> folders;
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (!error)
    folders.push_back(
        (program.parent_path().parent_path() / "share" / "placegraph" / kind).string());
  const fs::path source(PLACEGRAPH_SOURCE_CONFIGS);
  folders.push_back((kind == "configs" ? source : source / kind).string());
  return folders;
}

std::string config_path(const std::string& given) {
  if (fs::is_regular_file(given) || given.find_first_of("./") != std::string::npos) return given;
  for (const std::string& folder : shipped_folders("configs"))
    if (const fs::path path = fs::path(folder) / (given + ".yaml"); fs::exists(path))
      return path.string();
  const std::vector<std::string> names = shipped_configs();
  const std::string similar = did_you_mean(given, names);
  throw FileError(given, "no such file" + (similar.empty() ? fmt::format("; installed files are {}",
                                                                         fmt::join(names, ", "))
                                                           : similar));
}

}  // namespace placegraph::apps
