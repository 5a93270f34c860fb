#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph inspect PATH`.
void add_inspect_command(CLI::App& app);

}  // namespace placegraph::apps
