#pragma once
#include <fstream>
#include <string>

namespace placegraph {

/// Writes to `path` + a temporary suffix in the same folder and renames on commit(): a reader sees
/// the old file or the whole new one. Without commit() the temporary is removed.
/// Throws FileError if it cannot be opened, written or renamed.
class AtomicFile {
 public:
  explicit AtomicFile(std::string path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  std::ofstream& stream() { return stream_; }
  const std::string& temporary_path() const { return temporary_; }  ///< for libraries that open files
  void commit();

 private:
  std::string path_, temporary_;
  std::ofstream stream_;
  bool committed_ = false;
};

}  // namespace placegraph
