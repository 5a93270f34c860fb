#pragma once
#include <stdexcept>
#include <string>
#include <vector>

namespace placegraph::apps {

/// The data allowed no answer: `main` prints the reason and ends with exit code 1.
class NoAnswer : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A signal ended the command early: `main` prints the reason and ends with exit code 130.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws ArgumentError if a file stands at `path` already and `force` is not given, or if there is
/// no folder for it, FileError if nothing can be written there. To be called before the work whose
/// result goes there.
void require_free(const std::string& path, bool force);

/// The same for a folder of outputs: it may exist if it is empty.
void require_free_folder(const std::string& path, bool force);

/// A folder for results, made before the work they come from; where that ends without any, the
/// folders that were made are removed again. Throws FileError if it cannot be made or written into.
class OutputFolder {
 public:
  explicit OutputFolder(std::string path);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

 private:
  std::vector<std::string> made_;  ///< from the innermost on
};

/// Writes a whole file, atomically; bytes as they are. Throws FileError.
void write_file(const std::string& path, const std::string& content);

/// The text on stdout, as it is: what a command says of its result.
void print(const std::string& text);

/// The text as one line on stderr: what happened, or which spelling is new.
void note(const std::string& message);

/// "warning: ..." as one line on stderr.
void warn(const std::string& message);

/// The text in one line: what `main` does to foreign messages.
std::string one_line(const std::string& text);

}  // namespace placegraph::apps
