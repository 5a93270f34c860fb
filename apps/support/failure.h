#pragma once
#include <exception>
#include <string>

namespace placegraph::apps {

/// How the program ends.
enum class ExitCode {
  kSuccess = 0,
  kNoResult = 1,       ///< the data allow no result
  kUsage = 2,          ///< usage, configuration or file error
  kInternal = 3,       ///< no memory, or a fault of the program itself
  kInterrupted = 130,  ///< a signal ended a run; shells report SIGINT so
};

/// The exit codes, for users.
inline constexpr const char* kExitCodesText =
    "0 success, 1 the data allow no result, 2 usage, configuration or file error, 3 no memory or "
    "an internal error, 130 a signal ended a run";

/// What the program says of an exception, and how it ends.
struct Failure {
  ExitCode code = ExitCode::kInternal;
  std::string message;  ///< for users; one that is internal says so
};

/// The failure that an exception reports.
///
/// Exceptions of placegraph and of the file system are errors of usage or of a file. All others are
/// internal: a function has broken its contract.
Failure failure_of(const std::exception& error);

}  // namespace placegraph::apps
