#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph report RUN... -o FILE`, which writes a page that shows runs.
void add_report_command(CLI::App& app);

}  // namespace placegraph::apps
