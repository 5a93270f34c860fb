#pragma once
#include <CLI/App.hpp>
#include <memory>

namespace placegraph::apps {

/// The command line `placegraph GROUP COMMAND ...` with all groups and commands.
std::unique_ptr<CLI::App> make_command_line();

/// One line for a word that the parsed group does not know as a command, or an empty text.
std::string unknown_command(const CLI::App& app);

/// One line for the first word that the parsed command does not know, with similar words that it
/// knows; empty if it knows all.
std::string unknown_words(const CLI::App& app);

}  // namespace placegraph::apps
