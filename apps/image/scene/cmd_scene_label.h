#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph image labels INPUT --out DIR`, which classifies the pixels of a street.
void add_image_labels_command(CLI::App& image);

}  // namespace placegraph::apps
