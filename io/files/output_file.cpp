#include <fcntl.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/atomic_file.h>
#include <placegraph/io/files/output_file.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

namespace placegraph {
namespace fs = std::filesystem;

namespace {

/// Locks a folder against other processes; -1 where the file system has no locks.
int lock_folder(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return -1;
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return descriptor;
  const bool taken = errno == EWOULDBLOCK;
  ::close(descriptor);
  if (taken) throw FileError(path, "another program is writing into it");
  return -1;
}

}  // namespace

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
  locked_ = lock_folder(path);
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  for (const std::string& folder : made_) fs::remove(folder, ignored);  // only if it is empty
  if (locked_ >= 0) ::close(locked_);
}

std::string extension_of(const std::string& path) {
  return std::filesystem::path(path).extension().string();
}

void write_file(const std::string& path, const std::string& content) {
  AtomicFile file(path);
  file.stream().write(content.data(), static_cast<std::streamsize>(content.size()));
  file.commit();
}

}  // namespace placegraph
