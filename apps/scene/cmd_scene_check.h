#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph scene check LABELS DATA`: label images against those that people made.
void add_scene_check_command(CLI::App& scene);

}  // namespace placegraph::apps
