#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph lines detect IMAGE` and `placegraph lines match A B` and `placegraph lines track
/// SEQUENCE`: straight edges of images.
void add_lines_commands(CLI::App& image);

}  // namespace placegraph::apps
