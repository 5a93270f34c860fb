#include "apps/shell/cmd_shell.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "apps/shell/command_reference.h"
#include "apps/shell/completion.h"
#include "apps/shell/man_pages.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

void write_man_pages(const CLI::App& app, const std::string& folder, bool markdown) {
  const OutputFolder made(folder);
  if (markdown) {
    write_file((std::filesystem::path(folder) / "commands.md").string(), command_reference(app));
    return;
  }
  for (const ManPage& page : man_pages(app))
    write_file((std::filesystem::path(folder) / page.name).string(), page.text);
}

}  // namespace

void add_shell_commands(CLI::App& app) {
  auto shell = std::make_shared<std::string>();
  CLI::App* completion = app.add_subcommand("completion", "Print the completion script of a shell");
  completion->footer(
      "placegraph completion bash > ~/.local/share/bash-completion/completions/placegraph");
  completion->add_option("SHELL", *shell, "shell")
      ->required()
      ->check(CLI::IsMember(completion_shells()));
  completion->callback([&app, shell] { print(completion_script(app, *shell)); });

  // The spellings of the command line replace these words by flags; here they are for the help.
  app.add_subcommand("help", "Print the help of a command")->footer("placegraph help map export");
  app.add_subcommand("version", "Print the version")->footer("placegraph version");

  auto folder = std::make_shared<std::string>();
  CLI::App* man = app.add_subcommand("man", "Write the manual pages");
  man->footer("placegraph man share/man/man1");
  man
      ->add_option("FOLDER", *folder, "folder for one page per command")
      ->type_name(kOutput)
      ->required();
  auto markdown = std::make_shared<bool>(false);
  man->add_flag("--markdown", *markdown, "one page in Markdown, commands.md, in place of them");
  man->callback([&app, folder, markdown] { write_man_pages(app, *folder, *markdown); });
}

}  // namespace placegraph::apps
