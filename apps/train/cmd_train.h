#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph train WHAT DATA --out MODEL`: models learned from labelled data.
void add_train_command(CLI::App& app);

}  // namespace placegraph::apps
