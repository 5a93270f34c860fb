#pragma once
#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace placegraph::apps {

/// "bash", "fish" and "zsh".
std::vector<std::string> completion_shells();

/// Script by which a shell completes the commands, flags and choices of `app`.
/// Files are completed where a command takes anything else. Throws ArgumentError for other shells.
std::string completion_script(const CLI::App& app, const std::string& shell);

}  // namespace placegraph::apps
