#pragma once
#include <string>

namespace CLI {
class App;
}

namespace placegraph::apps {

/// Adds a group of commands, `placegraph NAME COMMAND`, with an example of one.
CLI::App& add_group(CLI::App& app, const std::string& name, const std::string& what,
                    const std::string& example);

}  // namespace placegraph::apps
