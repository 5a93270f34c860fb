#include "apps/shell/path_options.h"

#include <placegraph/io/datasets/distinct_paths.h>

#include <CLI/CLI.hpp>
#include <filesystem>

#include "apps/support/option_texts.h"

namespace placegraph::apps {

bool is_output(const CLI::Option& option) { return option.get_type_name().starts_with(kOutput); }

namespace {

bool takes_file(const CLI::Option& option) { return option.get_type_name().ends_with(":FILE"); }

}  // namespace

bool is_input(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  return type.starts_with(kInput) || takes_file(option) || type.ends_with(":DIR") ||
         type.ends_with(":PATH(existing)");
}

void require_distinct_paths(const CLI::App& command) {
  std::vector<NamedPath> outputs, inputs;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& path : option->results()) {
      if (is_output(*option)) outputs.push_back({option->get_name(), path});
      if (is_input(*option) && !(takes_file(*option) && std::filesystem::is_directory(path)))
        inputs.push_back({option->get_name(), path});
    }
  require_distinct_paths(outputs, inputs);
}

}  // namespace placegraph::apps
