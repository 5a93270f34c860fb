#pragma once
#include <sys/wait.h>

#include <cstdlib>

#include "tests/support/paths.h"
#include "tests/support/temporary_folder.h"

namespace placegraph::test {

/// What a command left behind.
struct CommandResult {
  int code = -1;  ///< exit status; -1 if it was killed
  std::string out, err;
};

inline void write_file(const std::string& path, const std::string& content) {
  std::ofstream(path, std::ios::binary) << content;
}

/// Runs `placegraph <arguments>` through the shell, in the given folder.
inline CommandResult run_placegraph(const std::string& arguments,
                                    const std::string& working_folder = ".") {
  const TemporaryFolder streams;
  const std::string command = "cd '" + working_folder + "' && '" + program() + "' " + arguments +
                              " >'" + (streams / "out") + "' 2>'" + (streams / "err") +
                              "' </dev/null";
  const int status = std::system(command.c_str());
  CommandResult result;
  if (WIFEXITED(status)) result.code = WEXITSTATUS(status);
  result.out = read_file(streams / "out");
  result.err = read_file(streams / "err");
  return result;
}

}  // namespace placegraph::test
