#pragma once
#include <string>

namespace CLI {
class App;
}

namespace placegraph::apps {

/// Adds `placegraph eval record TRUTH RUN... --out FILE`; `program` is name and version of this one.
void add_eval_record_command(CLI::App& eval_group, const std::string& program);

}  // namespace placegraph::apps
