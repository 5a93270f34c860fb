#include "apps/shell/man_pages.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "apps/shell/cmd_tree.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

/// Text as roff shows it: no character of it is an instruction.
std::string roff(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
  }
  return out.starts_with('.') || out.starts_with('\'') ? "\\&" + out : out;
}

std::string page_name(const CLI::App& command) {
  std::string name = full_name(command);
  std::ranges::replace(name, ' ', '-');
  return name;
}

std::string option_text(const CLI::Option& option) {
  std::string text = ".TP\n.B " + roff(option.get_name(!option.nonpositional(), true));
  if (option.get_items_expected_max() > 0 && option.nonpositional()) text += " \\fIVALUE\\fR";
  text += "\n" + roff(option.get_description());
  const std::string standard = option.get_default_str();
  if (!standard.empty()) text += " (default: " + roff(standard) + ")";
  return text + "\n";
}

/// The arguments and flags of a command, in sections of their own.
std::string options_text(const CLI::App& command) {
  std::string arguments, flags;
  for (const CLI::Option* option : command.get_options())
    if (!option->get_group().empty())
      (is_argument(*option) ? arguments : flags) += option_text(*option);
  return (arguments.empty() ? "" : ".SH ARGUMENTS\n" + arguments) +
         (flags.empty() ? "" : ".SH OPTIONS\n" + flags);
}

std::string arguments_text(const CLI::App& command) {
  std::string text;
  for (const CLI::Option* option : command.get_options())
    if (is_argument(*option)) text += " \\fI" + roff(option->get_name(true)) + "\\fR";
  return text;
}

std::string commands_text(const CLI::App& command) {
  std::string text;
  for (const CLI::App* sub : commands_of(command))
    text += ".TP\n.BR " + roff(page_name(*sub)) + " (1)\n" + roff(sub->get_description()) + "\n";
  return text.empty() ? text : ".SH COMMANDS\n" + text;
}

void list_pages(const CLI::App& command, std::vector<ManPage>& pages) {
  const std::string name = page_name(command);
  std::string title = name;
  std::ranges::transform(title, title.begin(), [](unsigned char c) { return std::toupper(c); });
  const bool is_group = !commands_of(command).empty();
  std::string text = fmt::format(".TH {} 1 \"\" \"placegraph {}\" \"placegraph\"\n", roff(title),
                                 PLACEGRAPH_VERSION);
  text += ".SH NAME\n" + roff(name) + " \\- " + roff(command.get_description()) + "\n";
  text += ".SH SYNOPSIS\n.B " + roff(full_name(command)) +
          (is_group ? "\n.I COMMAND\n" : "\n[\\fIOPTIONS\\fR]" + arguments_text(command) + "\n");
  text += commands_text(command) + options_text(command);
  text += ".SH EXAMPLE\n.EX\n" + roff(command.get_footer()) + "\n.EE\n";
  text += std::string(".SH EXIT STATUS\n") + kExitCodesText + ".\n";
  pages.push_back({name + ".1", text});
  for (const CLI::App* sub : commands_of(command)) list_pages(*sub, pages);
}

}  // namespace

std::vector<ManPage> man_pages(const CLI::App& app) {
  std::vector<ManPage> pages;
  list_pages(app, pages);
  return pages;
}

}  // namespace placegraph::apps
