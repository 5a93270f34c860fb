#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph config`: every option of `placegraph run`, with its default or as a file sets it.
void add_config_command(CLI::App& app);

}  // namespace placegraph::apps
