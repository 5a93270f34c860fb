#include "apps/cmd_group.h"

#include <CLI/CLI.hpp>

namespace placegraph::apps {

CLI::App& add_group(CLI::App& app, const std::string& name, const std::string& what,
                    const std::string& example) {
  CLI::App* group = app.add_subcommand(name, what);
  group->footer("placegraph " + name + " " + example);
  group->require_subcommand(1);
  return *group;
}

}  // namespace placegraph::apps
