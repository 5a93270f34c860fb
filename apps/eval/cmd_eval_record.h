#pragma once
namespace CLI {
class App;
}

namespace placegraph::apps {

/// Adds `placegraph eval record TRUTH RUN... --out FILE`.
void add_eval_record_command(CLI::App& eval_group);

}  // namespace placegraph::apps
