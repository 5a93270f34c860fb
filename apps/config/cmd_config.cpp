#include "apps/config/cmd_config.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "apps/config/config.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

const std::vector<std::string> kLevels = {"basic", "advanced", "internal"};  // as OptionLevel

struct ConfigCommand {
  ConfigArguments arguments;
  std::string level = "basic";
  bool all = false, list = false, markdown = false;
};

void print_config(ConfigCommand& command) {
  ConfigArguments& a = command.arguments;
  const auto level = std::find(kLevels.begin(), kLevels.end(), command.level) - kLevels.begin();
  a.level = static_cast<OptionLevel>(level);
  if (command.all) a.level = OptionLevel::kInternal;
  if (command.list) a.form = ConfigForm::kList;
  if (command.markdown) a.form = ConfigForm::kMarkdown;
  const std::string text = config(a);
  if (a.out.empty()) print(text);
}

}  // namespace

void add_config_command(CLI::App& app) {
  auto config_command = std::make_shared<ConfigCommand>();
  ConfigArguments& a = config_command->arguments;
  CLI::App* command = app.add_subcommand("config", "Print the options of `run` as YAML");
  command->footer("placegraph config --all > my.yaml");
  command->add_option("--config", a.config, kConfigText)->type_name(kInputFile);
  command->add_option("--set", a.settings, kSetText)->allow_extra_args(false);
  auto* all = command->add_flag("--all", config_command->all, "options of all levels");
  command->add_option("--level", config_command->level, "last level that is printed")
      ->check(CLI::IsMember(kLevels))
      ->capture_default_str()
      ->excludes(all);
  auto* list = command->add_flag("--list", config_command->list, "one option per line");
  command->add_flag("--markdown", config_command->markdown, "all options as docs/options.md")
      ->excludes(list)
      ->excludes(all);
  command->add_option("--of", a.of, "command whose options are printed")
      ->transform(CLI::Transformer(std::map<std::string, std::string>{{"hover", "flight"}}))
      ->check(CLI::IsMember({"run", "flight"}))
      ->capture_default_str();
  command->add_option("-o,--out", a.out, "file to write instead of standard output")
      ->type_name(kOutput);
  command->add_flag("--force", a.force, kForceText);
  command->callback([config_command] { print_config(*config_command); });
}

}  // namespace placegraph::apps
