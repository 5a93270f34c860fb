#pragma once
#include <placegraph/graph/image/image.h>

#include <filesystem>
#include <string>
#include <vector>

namespace placegraph::synthetic {

/// A folder that a rendered sequence is written to: what goes into it lies in a folder beside it
/// until everything is there. A folder that is not put in place is removed.
class SequenceFolder {
 public:
  /// Throws ArgumentError if `path` exists and is not an empty folder (unless `force`), FileError
  /// if nothing can be written there.
  SequenceFolder(const std::string& path, bool force);
  ~SequenceFolder();
  SequenceFolder(const SequenceFolder&) = delete;
  SequenceFolder& operator=(const SequenceFolder&) = delete;

  const std::filesystem::path& path() const { return temporary_; }  ///< to write to until then
  /// Paths are relative to the folder. All throw FileError.
  void make(const std::string& folder) const;
  /// PNG, quickly rather than tightly packed.
  void write(const std::string& file, const Image& image) const;
  void write(const std::string& file, const std::string& text) const;
  /// Moves all to its place. In a folder that holds something already only `parts`, what such a
  /// sequence consists of, are replaced or removed.
  void put_in_place(const std::vector<std::string>& parts);

 private:
  std::filesystem::path target_, temporary_;
};

}  // namespace placegraph::synthetic
