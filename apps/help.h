#pragma once
#include <CLI/CLI.hpp>
#include <string>

namespace placegraph::apps {

/// Writes help that begins with an example, the footer of a command.
class ExampleFormatter : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override;
  std::string make_footer(const CLI::App* app) const override;
  /// Lists the options that an option needs and excludes by name. CLI11 lists them by address,
  /// which differs from build to build.
  std::string make_option_opts(const CLI::Option* option) const override;
};

}  // namespace placegraph::apps
