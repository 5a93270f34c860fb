#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph places classify DIR --out FILE`, which predicts the labels of places.
void add_classify_command(CLI::App& places);

}  // namespace placegraph::apps
