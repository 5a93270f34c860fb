#pragma once
#include <CLI/App.hpp>
#include <functional>
#include <memory>
#include <string>

#include "apps/run/run_watcher.h"
#include "apps/server/viewer_options.h"

namespace placegraph::apps {

/// How a run is shown, by other folders of commands.
struct RunPresentation {
  /// Writes the page that shows the run in a folder to a file (`--report`).
  std::function<void(const std::string& folder, const std::string& file)> write_page;
  /// Shows a run while it goes on (`--view`); `title` names it.
  std::function<std::unique_ptr<RunDisplay>(const ViewerOptions& options, const std::string& title)>
      show;
};

/// Adds `placegraph run`: images in, trajectory and place graph out.
void add_run_command(CLI::App& app, const RunPresentation& presentation);

}  // namespace placegraph::apps
