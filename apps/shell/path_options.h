#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Whether the value of an option is a path that its command writes (kOutput).
bool is_output(const CLI::Option& option);
/// Whether it is a path that its command reads: kInput, or one that is checked to exist.
bool is_input(const CLI::Option& option);

/// Checks the paths that a parsed command was given by require_distinct_paths.
void require_distinct_paths(const CLI::App& command);

}  // namespace placegraph::apps
