#pragma once
#include <CLI/App.hpp>
#include <string>

namespace placegraph::apps {

/// docs/commands.md: every command with its arguments and flags, in Markdown, from the same tree as
/// the help. Throws ArgumentError for a command without a page in docs/.
std::string command_reference(const CLI::App& app);

}  // namespace placegraph::apps
