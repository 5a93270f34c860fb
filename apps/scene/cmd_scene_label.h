#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph scene label INPUT --out DIR`: what each pixel of a street is.
void add_image_labels_command(CLI::App& image);

}  // namespace placegraph::apps
