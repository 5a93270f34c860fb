#pragma once
namespace CLI {
class App;
}

namespace placegraph::apps {

/// Adds `placegraph eval gate BASELINE CANDIDATE...`.
void add_eval_gate_command(CLI::App& eval_group);

}  // namespace placegraph::apps
