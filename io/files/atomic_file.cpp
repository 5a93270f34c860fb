#include <fcntl.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/atomic_file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

namespace placegraph {
namespace fs = std::filesystem;
namespace {

/// Creates a new file, so that two writers never share a temporary file.
std::string create_temporary(const std::string& path) {
  const fs::path target(path);
  for (int attempt = 0; attempt < 1000; ++attempt) {
    fs::path candidate = target.parent_path() / target.stem();
    candidate += ".tmp-" + std::to_string(::getpid()) + "-" + std::to_string(attempt);
    candidate += target.extension();
    const int descriptor = ::open(candidate.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    if (descriptor >= 0) {
      ::close(descriptor);
      return candidate.string();
    }
    if (errno != EEXIST) break;
  }
  throw FileError(path, std::string("cannot be written: ") + std::strerror(errno));
}

/// Waits until a file, or the names in a folder, are on the disk; returns whether they are.
bool is_on_disk(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool done = ::fsync(descriptor) == 0;
  const int error = errno;
  ::close(descriptor);
  errno = error;
  return done;
}

}  // namespace

AtomicFile::AtomicFile(std::string path) : path_(std::move(path)) {
  if (path_.empty()) throw ArgumentError("the path of an output file is empty");
  std::error_code ignored;
  const fs::file_status status = fs::status(path_, ignored);
  if (fs::is_directory(status)) throw FileError(path_, "is a folder, not a file");
  const bool replaces = fs::is_regular_file(status);
  if (replaces && fs::is_symlink(path_, ignored)) path_ = fs::canonical(path_).string();
  if (replaces || !fs::exists(status)) temporary_ = create_temporary(path_);
  stream_.open(temporary_path(), std::ios::binary | std::ios::trunc);
  if (!stream_) {
    if (!temporary_.empty()) std::remove(temporary_.c_str());
    throw FileError(path_, "cannot be opened for writing");
  }
}

AtomicFile::~AtomicFile() {
  if (committed_) return;
  stream_.close();
  if (!temporary_.empty()) std::remove(temporary_.c_str());
}

void AtomicFile::commit() {
  if (committed_) return;
  stream_.close();
  if (!stream_) throw FileError(path_, "cannot be written (is the disk full?)");
  if (!temporary_.empty()) replace_file(temporary_, path_);
  committed_ = true;
}

void replace_file(const std::string& fresh, const std::string& path) {
  const auto require_done = [&](bool done) {
    if (!done) throw FileError(path, std::string("cannot be written: ") + std::strerror(errno));
  };
  require_done(is_on_disk(fresh));
  require_done(std::rename(fresh.c_str(), path.c_str()) == 0);
  const fs::path folder = fs::path(path).parent_path();
  // The file is there. Some folders cannot be opened: then the system decides when it is on disk.
  (void)is_on_disk(folder.empty() ? "." : folder.string());
}

void make_output_folder(const std::string& path) {
  if (path.empty()) throw ArgumentError("the path of the output folder is empty");
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw FileError(path, "cannot be created: " + error.message());
  if (!fs::is_directory(path)) throw FileError(path, "exists and is not a folder");
}

}  // namespace placegraph
