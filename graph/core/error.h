#pragma once
#include <stdexcept>
#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// Base of every exception that the library throws itself.
/// It reports an error of the caller, an invalid option or a broken file. The message is one line
/// that names the field or `file:line` and the value. If the data allow no estimate, nothing is
/// thrown but NoResult: see outcome.h.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An argument or option outside its contract.
class ArgumentError : public Error {
 public:
  using Error::Error;
};

/// A file that is missing, truncated or malformed.
class FileError : public Error {
 public:
  /// `what()` is "path:line: message"; lines count from 1.
  /// With a line of 0 or less it is "path: message".
  FileError(const std::string& path, int line, const std::string& message);
  /// `what()` is "path: message", for a fault of the file as a whole.
  FileError(const std::string& path, const std::string& message) : FileError(path, 0, message) {}
};

/// Data that allow no result where one must be written: a file would be empty or meaningless.
class NoResult : public Error {
 public:
  using Error::Error;
};

/// Throws ArgumentError(message) unless `condition` holds.
inline void require(bool condition, const char* message) {
  if (!condition) throw ArgumentError(message);
}
/// Throws ArgumentError(message) unless `condition` holds; for messages that are composed.
inline void require(bool condition, const std::string& message) {
  if (!condition) throw ArgumentError(message);
}

}  // namespace placegraph
