#pragma once
#include <CLI/App.hpp>
#include <memory>

namespace placegraph::apps {

/// The command line `placegraph GROUP COMMAND ...` with all groups and commands.
std::unique_ptr<CLI::App> make_command_line();

/// One line for the first word that the parsed command does not know, with similar words that it
/// knows; empty if it knows all.
std::string unknown_words(const CLI::App& app);

}  // namespace placegraph::apps
