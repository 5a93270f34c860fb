#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph scene label INPUT --out DIR`: what each pixel of a street is.
void add_scene_label_command(CLI::App& scene);

}  // namespace placegraph::apps
