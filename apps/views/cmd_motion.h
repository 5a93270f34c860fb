#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph motion MATCHES.txt --calib K.txt`: the relative pose of two views.
void add_motion_command(CLI::App& image);

}  // namespace placegraph::apps
