#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph train WHAT DATA --out MODEL`: models learned from labelled data.
void add_train_commands(CLI::App& train);

}  // namespace placegraph::apps
