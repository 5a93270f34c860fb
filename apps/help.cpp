#include "apps/help.h"

#include <set>

namespace placegraph::apps {
namespace {

/// Text " LABEL: --a --b"; empty without options.
std::string by_name(const std::string& label, const std::set<CLI::Option*>& options) {
  std::set<std::string> names;
  for (const CLI::Option* option : options) names.insert(option->get_name());
  std::string text = names.empty() ? "" : " " + label + ":";
  for (const std::string& name : names) text += " " + name;
  return text;
}

}  // namespace

std::string ExampleFormatter::make_help(const CLI::App* app, std::string name,
                                        CLI::AppFormatMode mode) const {
  const std::string help = CLI::Formatter::make_help(app, std::move(name), mode);
  if (mode == CLI::AppFormatMode::Sub || app->get_footer().empty()) return help;
  return "Example: " + app->get_footer() + "\n\n" + help;
}

std::string ExampleFormatter::make_footer(const CLI::App*) const { return {}; }

std::string ExampleFormatter::make_option_opts(const CLI::Option* option) const {
  const std::string needs = get_label("Needs"), excludes = get_label("Excludes");
  std::string text = CLI::Formatter::make_option_opts(option);
  for (const std::string& label : {needs, excludes})
    text = text.substr(0, text.find(" " + label + ": "));
  return text + by_name(needs, option->get_needs()) + by_name(excludes, option->get_excludes());
}

}  // namespace placegraph::apps
