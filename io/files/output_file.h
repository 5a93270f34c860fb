#pragma once
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Checks that a file can be written to `path`, before the work for its content.
/// Throws ArgumentError if the file exists and `force` is not set, or if its folder does not exist,
/// and FileError if nothing can be written there.
void require_free(const std::string& path, bool force);

/// The same for an output folder, which may exist if it is empty.
void require_free_folder(const std::string& path, bool force);

/// A folder for results, made before the work for them.
/// If the work ends without results, the folders that were made are removed. The folder is locked
/// until then: throws FileError if another process has locked it, or if it cannot be made or
/// written to.
class OutputFolder {
 public:
  explicit OutputFolder(std::string path);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

 private:
  std::vector<std::string> made_;  ///< folders that were made, from the innermost on
  int locked_ = -1;                ///< descriptor of the folder; its lock ends with it
};

/// Creates the folder and its parents; an existing one is accepted.
/// (The caller decides whether its content may be overwritten.) Throws FileError if it cannot be
/// created.
void make_output_folder(const std::string& path);

/// The extension of a file name with its dot; empty if there is none.
std::string extension_of(const std::string& path);

/// Writes a whole file, atomically; bytes as they are. Throws FileError.
void write_file(const std::string& path, const std::string& content);

}  // namespace placegraph
