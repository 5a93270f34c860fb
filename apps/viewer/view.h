#pragma once
#include <string>
#include <vector>

#include "apps/viewer/viewer.h"

namespace placegraph::apps {

struct ViewArguments {
  std::vector<std::string> runs;  ///< folders that `placegraph run` wrote, or their maps
  ViewerOptions viewer;
  std::string program;  ///< name and version of the program, for the page
};

/// `placegraph view`: serves the page of runs until SIGINT, SIGTERM or SIGHUP.
///
/// One run alone can be edited there. Prints the address on stdout. Throws FileError for a map that
/// cannot be read.
void view(const ViewArguments& arguments);

}  // namespace placegraph::apps
