#pragma once
#include <stdexcept>
#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// Base of every exception the library throws: a caller's mistake, a bad option or a broken file.
/// The message is one line that names the field or `file:line` and the value seen.
/// When the data merely allow no estimate, nothing is thrown: see outcome.h.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An argument or option outside its contract.
class ArgumentError : public Error {
 public:
  using Error::Error;
};

/// A file that is missing, truncated or malformed. `what()` is "path:line: message", or
/// "path: message" when `line` is 0 (lines count from 1).
class FileError : public Error {
 public:
  FileError(const std::string& path, int line, const std::string& message);
  FileError(const std::string& path, const std::string& message) : FileError(path, 0, message) {}
};

/// Throws ArgumentError(message) unless `condition` holds.
inline void require(bool condition, const char* message) {
  if (!condition) throw ArgumentError(message);
}
inline void require(bool condition, const std::string& message) {
  if (!condition) throw ArgumentError(message);
}

}  // namespace placegraph
