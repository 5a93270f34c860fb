#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph eval table SYSTEM... --truth DIR`, a table of sequences and systems.
void add_eval_table_command(CLI::App& eval_group);

}  // namespace placegraph::apps
