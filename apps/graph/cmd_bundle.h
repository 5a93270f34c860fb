#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph bundle IN.txt [-o OUT.txt]`: full bundle adjustment of a problem in BAL's form.
void add_bundle_command(CLI::App& graph);

}  // namespace placegraph::apps
