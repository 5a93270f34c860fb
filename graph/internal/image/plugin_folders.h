#pragma once
#include <string>
#include <vector>

namespace placegraph {

/// Where modules of the library are looked for, in this order: the folder that the environment
/// variable PLACEGRAPH_PLUGIN_DIR names; that of the build tree, for what runs inside it;
/// `../lib/placegraph` and `placegraph` beside the program or shared library that holds this
/// function; the folder of the installation that was configured.
std::vector<std::string> plugin_folders();

}  // namespace placegraph
