#pragma once
#include <string>
#include <vector>

namespace placegraph {

/// Folders that are searched for modules of the library, in this order: the folder in the
/// environment variable PLACEGRAPH_PLUGIN_DIR; the folder of the build tree, for programs inside
/// it; `../lib/placegraph` and `placegraph` beside the program or shared library that contains this
/// function; the folder of the installation that was configured.
std::vector<std::string> plugin_folders();

}  // namespace placegraph
