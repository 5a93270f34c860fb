#include "apps/server/cmd_viewer_options.h"

#include <CLI/CLI.hpp>

namespace placegraph::apps {

void add_viewer_options(CLI::App& command, ViewerOptions& options) {
  command.add_option("--port", options.port, "port of the page on 127.0.0.1; default: a free one")
      ->check(CLI::Range(1, 65535));
  command.add_flag("--open", options.open, "open the page in the browser");
}

}  // namespace placegraph::apps
