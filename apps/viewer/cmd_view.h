#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph view RUN...`, which serves a page that shows runs.
void add_view_command(CLI::App& app);

}  // namespace placegraph::apps
