#pragma once
#include <placegraph/graph/image/image.h>

#include <filesystem>
#include <string>
#include <vector>

namespace placegraph::synthetic {

/// The output folder of a rendered sequence. Files are collected in a folder beside it until all
/// are written; a folder that is not put in place is removed.
class SequenceFolder {
 public:
  /// Throws ArgumentError if `path` exists and is not an empty folder (unless `force`), FileError
  /// if nothing can be written there.
  SequenceFolder(const std::string& path, bool force);
  ~SequenceFolder();
  SequenceFolder(const SequenceFolder&) = delete;
  SequenceFolder& operator=(const SequenceFolder&) = delete;

  const std::filesystem::path& path() const {
    return temporary_;
  }  ///< folder to write to until put_in_place()
  /// Paths are relative to the folder. All throw FileError.
  void make(const std::string& folder) const;
  /// Writes a PNG, with fast rather than strong compression.
  void write(const std::string& file, const Image& image) const;
  void write(const std::string& file, const std::string& text) const;
  /// Moves all files to their place. In a folder with content, only `parts`, the files of such a
  /// sequence, are replaced or removed.
  void put_in_place(const std::vector<std::string>& parts);

 private:
  std::filesystem::path target_, temporary_;
};

}  // namespace placegraph::synthetic
