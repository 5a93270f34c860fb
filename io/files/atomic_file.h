#pragma once
#include <placegraph/io/files/output_file.h>

#include <fstream>
#include <string>

namespace placegraph {

/// Writes to a temporary file beside `path` (its name with a suffix before the extension, so that
/// libraries that depend on the extension can write it too) and renames it on commit(): a reader
/// sees the old file or the whole new one. Without commit() the temporary file is removed. If
/// `path` is a link to a file, that file is replaced; a path that is not a file, such as
/// /dev/stdout, is written directly. After a power cut, too, the old file or the whole new one is
/// there. Throws FileError if it cannot be opened, written or renamed.
class AtomicFile {
 public:
  explicit AtomicFile(std::string path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  std::ofstream& stream() { return stream_; }
  /// The path for libraries that open files themselves.
  const std::string& temporary_path() const { return temporary_.empty() ? path_ : temporary_; }
  void commit();

 private:
  std::string path_, temporary_;  ///< temporary_ is empty if there is none
  std::ofstream stream_;
  bool committed_ = false;
};

/// Renames `fresh`, which is closed, to `path`, which it replaces. The content is on the disk
/// before the name: after a power cut `path` has the old content or the whole new one. Throws
/// FileError.
void replace_file(const std::string& fresh, const std::string& path);

}  // namespace placegraph
