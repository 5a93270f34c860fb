#pragma once
#include <CLI/CLI.hpp>
#include <string>

namespace placegraph::apps {

/// Help that begins with an example: a command's footer is its example line, and is shown first.
class ExampleFormatter : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override;
  std::string make_footer(const CLI::App* app) const override;
  /// What an option needs and excludes by name: CLI11 lists it by address, another way in every
  /// build.
  std::string make_option_opts(const CLI::Option* option) const override;
};

/// "placegraph eval --help" for the command that was being parsed.
std::string help_command(const CLI::App& app);

}  // namespace placegraph::apps
