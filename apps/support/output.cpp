#include "apps/support/output.h"

#include <placegraph/graph/core/error.h>
#include <placegraph/io/internal/files/atomic_file.h>

#include <cstdio>
#include <filesystem>

namespace placegraph::apps {
namespace fs = std::filesystem;

void require_free(const std::string& path, bool force) {
  const fs::path folder = fs::path(path).parent_path();
  require(folder.empty() || fs::is_directory(folder),
          path + ": cannot be written: there is no folder " + folder.string());
  const fs::file_status status = fs::status(path);
  require(!fs::is_directory(status), path + ": is a folder, a file is to be written there");
  require(force || !fs::is_regular_file(status), path + ": exists already; --force overwrites it");
  if (!fs::exists(status) || fs::is_regular_file(status)) AtomicFile probe(path);
}

void require_free_folder(const std::string& path, bool force) {
  if (!fs::exists(path)) return;
  require(fs::is_directory(path), path + ": is a file, a folder is to be written there");
  require(force || fs::is_empty(path), path + ": is not empty; --force writes into it");
}

OutputFolder::OutputFolder(std::string path) {
  while (path.size() > 1 && path.back() == '/') path.pop_back();
  for (fs::path folder = path; !folder.empty() && !fs::exists(folder);
       folder = folder.parent_path())
    made_.push_back(folder.string());
  make_output_folder(path);
  AtomicFile probe((fs::path(path) / "probe").string());
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  for (const std::string& folder : made_) fs::remove(folder, ignored);  // only if it is empty
}

void write_file(const std::string& path, const std::string& content) {
  AtomicFile file(path);
  file.stream().write(content.data(), static_cast<std::streamsize>(content.size()));
  file.commit();
}

void print(const std::string& text) { std::fwrite(text.data(), 1, text.size(), stdout); }

void note(const std::string& message) { std::fprintf(stderr, "%s\n", one_line(message).c_str()); }

LogSink option_notes() {
  return [](LogLevel, const std::string& message) { note(message); };
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
