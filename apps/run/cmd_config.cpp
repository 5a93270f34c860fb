#include "apps/run/cmd_config.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/run/config.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_config_command(CLI::App& app) {
  auto arguments = std::make_shared<ConfigArguments>();
  auto yaml = std::make_shared<bool>(false), markdown = std::make_shared<bool>(false);
  ConfigArguments& a = *arguments;
  CLI::App* command =
      app.add_subcommand("config", "List every option of run, or write them as YAML");
  command->footer("placegraph config --dump > my.yaml");
  command->add_option("--config", a.config, "YAML file to start from instead of the defaults");
  command->add_option("--set", a.settings, kSetText)
      ->allow_extra_args(false);
  auto* dump = command->add_flag("--dump", *yaml, "as YAML that --config takes back");
  command->add_flag("--markdown", *markdown, "as docs/options.md")->excludes(dump);
  command->add_option("--of", arguments->of, "whose options: run or flight")
      ->check(CLI::IsMember({"run", "flight"}))
      ->capture_default_str();
  command->add_option("-o,--out", a.out, "write to a file instead of stdout");
  command->add_flag("--force", a.force, kForceText);
  command->callback([arguments, yaml, markdown] {
    if (*yaml) arguments->form = ConfigForm::kYaml;
    if (*markdown) arguments->form = ConfigForm::kMarkdown;
    const std::string text = config(*arguments);
    if (arguments->out.empty()) print(text);
  });
}

}  // namespace placegraph::apps
