#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph places classify DIR --out FILE`: labelled places, learned and told.
void add_classify_command(CLI::App& places);

}  // namespace placegraph::apps
