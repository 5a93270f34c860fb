#include "apps/run/cmd_config.h"

#include <fmt/format.h>
#include <placegraph/io/config/yaml_config.h>
#include <placegraph/pipeline/flight/flight_estimator.h>
#include <placegraph/pipeline/run.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>

#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

struct ConfigArguments {
  std::string config, out, of = "run";
  std::vector<std::string> settings;
  bool dump = false, markdown = false, force = false;
};

std::string plain_list(const std::vector<OptionEntry>& entries) {
  std::size_t key_width = 0, value_width = 0;
  for (const OptionEntry& entry : entries) {
    if (entry.type == "group") continue;
    key_width = std::max(key_width, entry.path.size());
    value_width = std::max(value_width, entry.value.size());
  }
  std::string text;
  for (const OptionEntry& entry : entries)
    if (entry.type != "group")
      text += fmt::format("{:<{}}  {:<{}}  {}\n", entry.path, key_width, entry.value, value_width,
                          entry.doc);
  return text;
}

/// The options as they stand after the file and the settings, in the form asked for.
template <class Options>
std::string text_of(const ConfigArguments& arguments) {
  Options options;
  if (!arguments.config.empty()) read_options(arguments.config, options);
  for (const std::string& setting : arguments.settings) set_option(options, setting);
  options.check();
  if (arguments.dump) return dump_options(options);
  if (arguments.markdown)
    return "# Options of `placegraph " + arguments.of +
           "`\n\nWritten by `placegraph config --markdown`; set them in a file (`--config`) or by "
           "`--set key=value`.\n\n" +
           options_markdown(options);
  return plain_list(list_options(options));
}

void run(const ConfigArguments& arguments) {
  if (!arguments.out.empty()) require_free(arguments.out, arguments.force);
  const std::string text =
      arguments.of == "hover" ? text_of<HoverOptions>(arguments) : text_of<RunOptions>(arguments);
  if (arguments.out.empty())
    std::fputs(text.c_str(), stdout);
  else
    write_file(arguments.out, text);
}

}  // namespace

void add_config_command(CLI::App& app) {
  auto arguments = std::make_shared<ConfigArguments>();
  ConfigArguments& a = *arguments;
  CLI::App* command =
      app.add_subcommand("config", "List every option of run, or write them as YAML");
  command->footer("placegraph config --dump > my.yaml");
  command->add_option("--config", a.config, "YAML file to start from instead of the defaults");
  command->add_option("--set", a.settings, "one option, key=value; may be repeated")
      ->allow_extra_args(false);
  auto* dump = command->add_flag("--dump", a.dump, "as YAML that --config takes back");
  command->add_flag("--markdown", a.markdown, "as docs/options.md")->excludes(dump);
  command->add_option("--of", arguments->of, "whose options: run or hover")
      ->check(CLI::IsMember({"run", "hover"}))
      ->capture_default_str();
  command->add_option("--out", a.out, "write to a file instead of stdout");
  command->add_flag("--force", a.force, "overwrite it");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace placegraph::apps
