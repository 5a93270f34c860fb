#include "apps/output.h"

#include <placegraph/graph/core/error.h>
#include <placegraph/io/atomic_file.h>

#include <cstdio>
#include <filesystem>

namespace placegraph::apps {
namespace fs = std::filesystem;

void require_free(const std::string& path, bool force) {
  const fs::path folder = fs::path(path).parent_path();
  require(folder.empty() || fs::is_directory(folder),
          path + ": cannot be written: there is no folder " + folder.string());
  if (!fs::exists(path)) return;
  require(!fs::is_directory(path), path + ": is a folder, a file is to be written there");
  require(force, path + ": exists already; --force overwrites it");
}

void require_free_folder(const std::string& path, bool force) {
  if (!fs::exists(path)) return;
  require(fs::is_directory(path), path + ": is a file, a folder is to be written there");
  require(force || fs::is_empty(path), path + ": is not empty; --force writes into it");
}

void write_file(const std::string& path, const std::string& content) {
  AtomicFile file(path);
  file.stream().write(content.data(), static_cast<std::streamsize>(content.size()));
  file.commit();
}

void warn(const std::string& message) {
  std::fprintf(stderr, "warning: %s\n", one_line(message).c_str());
}

std::string one_line(const std::string& text) {
  std::string line;
  for (const char c : text) {
    const bool space = c == '\n' || c == '\r' || c == '\t' || c == ' ';
    if (!space)
      line += c;
    else if (!line.empty() && line.back() != ' ')
      line += ' ';
  }
  while (!line.empty() && line.back() == ' ') line.pop_back();
  return line;
}

}  // namespace placegraph::apps
