// The command line: `placegraph GROUP COMMAND ...`. Exit codes: apps/support/output.h.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#ifdef __GLIBC__  // defined by the headers of the C++ library
#include <malloc.h>
#endif

#include "apps/command_line.h"
#include "apps/shell/cmd_tree.h"
#include "apps/shell/spellings.h"
#include "apps/support/output.h"

namespace {

using placegraph::apps::ExitCode;

int complain(ExitCode code, const std::string& message) {
  std::fprintf(stderr, "placegraph: %s\n", placegraph::apps::one_line(message).c_str());
  return static_cast<int>(code);
}

/// Every frame allocates and frees its images. Keeping that memory instead of returning it to the
/// system, which clears it, saves a twentieth of a run.
void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int kLargestKept = 64 << 20, kKept = 256 << 20;  // bytes
  mallopt(M_MMAP_THRESHOLD, kLargestKept);
  mallopt(M_TRIM_THRESHOLD, kKept);
#endif
}

std::string see_help(const CLI::App& app) {
  return " (see " + placegraph::apps::full_name(placegraph::apps::parsed_command(app)) + " --help)";
}

int parse_and_run(CLI::App& app, placegraph::apps::CommandWords line) {
  for (const std::string& note : line.notes) placegraph::apps::note(note);
  try {
    std::reverse(line.words.begin(), line.words.end());  // the order that the parser expects
    app.parse(line.words);
    return 0;
  } catch (const CLI::Success& asked) {  // --help, --version
    const std::string unknown = placegraph::apps::unknown_command(app);
    return unknown.empty() ? app.exit(asked) : complain(ExitCode::kUsage, unknown + see_help(app));
  } catch (const CLI::ParseError& error) {
    const std::string unknown = placegraph::apps::unknown_words(app);
    return complain(ExitCode::kUsage, (unknown.empty() ? error.what() : unknown) + see_help(app));
  }
}

}  // namespace

int main(int argc, char** argv) {
  using namespace placegraph::apps;
  keep_freed_memory();
  try {
    const auto app = make_command_line();
    const int code = parse_and_run(*app, present_spelling({argv + 1, argv + argc}));
    finish_printing();
    return code;
  } catch (const std::exception& error) {
    const Failure failure = failure_of(error);
    return complain(failure.code, failure.message);
  }
}
