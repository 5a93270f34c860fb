#pragma once
#include <CLI/App.hpp>
#include <memory>

namespace placegraph::apps {

/// The command line `placegraph GROUP COMMAND ...` with all groups and commands.
std::unique_ptr<CLI::App> make_command_line();

/// The subcommands of a command in the order of the help, hidden ones left out.
std::vector<const CLI::App*> commands_of(const CLI::App& command);

/// The command that was parsed last: the innermost one. `app` itself if there is none.
const CLI::App& parsed_command(const CLI::App& app);

/// The names that lead to a command: "placegraph map export".
std::string full_name(const CLI::App& command);

/// One line for the first word that the parsed command does not know, with similar words that it
/// knows; empty if it knows all.
std::string unknown_words(const CLI::App& app);

}  // namespace placegraph::apps
