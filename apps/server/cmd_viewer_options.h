#pragma once
#include <CLI/App.hpp>

#include "apps/server/viewer_options.h"

namespace placegraph::apps {

/// Adds `--port` and `--open` to a command that shows a page.
void add_viewer_options(CLI::App& command, ViewerOptions& options);

}  // namespace placegraph::apps
