#include "apps/help.h"

namespace placegraph::apps {

std::string ExampleFormatter::make_help(const CLI::App* app, std::string name,
                                        CLI::AppFormatMode mode) const {
  const std::string help = CLI::Formatter::make_help(app, std::move(name), mode);
  if (mode == CLI::AppFormatMode::Sub || app->get_footer().empty()) return help;
  return "Example: " + app->get_footer() + "\n\n" + help;
}

std::string ExampleFormatter::make_footer(const CLI::App*) const { return {}; }

std::string help_command(const CLI::App& app) {
  std::string command = app.get_name();
  for (const CLI::App* sub : app.get_subcommands()) command += " " + sub->get_name();
  return command + " --help";
}

}  // namespace placegraph::apps
