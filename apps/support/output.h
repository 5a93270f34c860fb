#pragma once
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/log.h>
#include <placegraph/graph/geometry/trajectory.h>
#include <placegraph/io/files/output_file.h>

#include <exception>
#include <stdexcept>
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

/// A signal ended the command early: `main` prints the reason and ends with exit code 130.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

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

/// Prints the result of a command on stdout. Throws Error if that cannot be written.
void print(const std::string& text);
/// Writes what is buffered on stdout; Error as print().
void finish_printing();

/// Prints a note as one line on stderr.
void note(const std::string& message);

/// Prints notes on old spellings of options, as a sink of read_options and set_option.
LogSink option_notes();

/// Prints notes and warnings, as a sink of the library; messages of other levels are left out.
LogSink messages();

/// Prints "warning: ..." as one line on stderr.
void warn(const std::string& message);

/// The trajectory, after its reader's warnings are printed so.
Trajectory warned(Trajectory trajectory);

/// The text in one line, as messages are printed: control characters are escaped, and of a very
/// long text only its begin and end are kept.
std::string one_line(const std::string& text);

}  // namespace placegraph::apps
