#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph config`, which prints the options of `placegraph run` or `flight run`.
void add_config_command(CLI::App& app);

}  // namespace placegraph::apps
