#pragma once
#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace placegraph::apps {

/// The subcommands of a command in the order of the help, hidden ones left out.
std::vector<const CLI::App*> commands_of(const CLI::App& command);

/// The command that was parsed last: the innermost one. `app` itself if there is none.
const CLI::App& parsed_command(const CLI::App& app);

/// True for an argument that is named by its position alone.
bool is_argument(const CLI::Option& option);

/// The values that an option takes, if they are a fixed list: a and b of the type "TEXT:{a,b}".
std::vector<std::string> choices_of(const CLI::Option& option);

/// The names that lead to a command: "placegraph map export".
std::string full_name(const CLI::App& command);

}  // namespace placegraph::apps
