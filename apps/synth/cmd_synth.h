#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// Adds `placegraph synth sequence WORLD|POSES.txt --out DIR`.
/// It renders a sequence with exact ground truth.
void add_synth_sequence_command(CLI::App& synth_group);

}  // namespace placegraph::apps
