#pragma once
#include <fstream>
#include <string>

namespace placegraph {

/// Writes to a temporary file beside `path` (its name with a suffix before the extension, so that
/// libraries that go by the extension can write it too) and renames it on commit(): a reader sees
/// the old file or the whole new one. Without commit() the temporary is removed. Where `path` is a
/// link to a file, that file is replaced; what is no file, as /dev/stdout, is written as it comes.
/// Throws FileError if it cannot be opened, written or renamed.
class AtomicFile {
 public:
  explicit AtomicFile(std::string path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  std::ofstream& stream() { return stream_; }
  /// For libraries that open files.
  const std::string& temporary_path() const { return temporary_.empty() ? path_ : temporary_; }
  void commit();

 private:
  std::string path_, temporary_;  ///< temporary_: empty where there is none
  std::ofstream stream_;
  bool committed_ = false;
};

/// Makes the folder and its parents; one that exists is taken as it is (whether anything in it may
/// be overwritten is the caller's question). Throws FileError if it cannot be made.
void make_output_folder(const std::string& path);

}  // namespace placegraph
