#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph completion SHELL` and `placegraph man FOLDER`, for the whole of `app`.
void add_shell_commands(CLI::App& app);

}  // namespace placegraph::apps
