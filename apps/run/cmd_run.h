#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph run`: images in, trajectory and place graph out.
void add_run_command(CLI::App& app);

}  // namespace placegraph::apps
