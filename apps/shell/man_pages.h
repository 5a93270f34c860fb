#pragma once
#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace placegraph::apps {

/// A manual page in roff.
struct ManPage {
  std::string name;  ///< file name, as "placegraph-map-export.1"
  std::string text;
};

/// One page for the program and one for each group and command.
std::vector<ManPage> man_pages(const CLI::App& app);

}  // namespace placegraph::apps
