#pragma once
#include <CLI/App.hpp>

namespace placegraph::apps {

/// `placegraph flow A B --method M --out F.flo --draw F.png`: optical flow between two images.
void add_flow_command(CLI::App& image);

}  // namespace placegraph::apps
