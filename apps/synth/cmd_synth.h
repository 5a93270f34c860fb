#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph synth WORLD|POSES.txt --out DIR`: renders a sequence with exact ground truth.
void add_synth_sequence_command(CLI::App& synth_group);

}  // namespace placegraph::apps
