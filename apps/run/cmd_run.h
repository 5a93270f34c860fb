#pragma once
#include <CLI/App.hpp>
#include <functional>
#include <string>

namespace placegraph::apps {

/// Adds `placegraph run`: images in, trajectory and place graph out.
/// `write_page` writes the page that shows the run in a folder to a file (`--report`).
void add_run_command(
    CLI::App& app,
    const std::function<void(const std::string& folder, const std::string& file)>& write_page);

}  // namespace placegraph::apps
