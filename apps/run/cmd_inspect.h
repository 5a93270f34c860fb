#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph inspect FOLDER`.
void add_inspect_command(CLI::App& app);

}  // namespace placegraph::apps
