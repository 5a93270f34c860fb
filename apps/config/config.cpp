#include "apps/config/config.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/config/yaml_config.h>
#include <placegraph/pipeline/run.h>

#include <algorithm>

#include "apps/config/config_of.h"
#include "apps/config/flight_config.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

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

/// The fields up to a level, with their groups.
std::vector<OptionEntry> up_to(OptionLevel level, const std::vector<OptionEntry>& entries) {
  std::vector<OptionEntry> kept;
  for (const OptionEntry& entry : entries) {
    while (!kept.empty() && kept.back().type == "group" &&
           !entry.path.starts_with(kept.back().path + "."))
      kept.pop_back();
    if (entry.type == "group" || entry.level <= level) kept.push_back(entry);
  }
  while (!kept.empty() && kept.back().type == "group") kept.pop_back();
  return kept;
}

}  // namespace

std::string config_text(const ConfigArguments& arguments, const std::vector<OptionEntry>& all) {
  const std::vector<OptionEntry> entries = up_to(arguments.level, all);
  if (arguments.form == ConfigForm::kYaml) return dump_options(entries);
  if (arguments.form == ConfigForm::kMarkdown)
    return "# Options of `placegraph " + arguments.of +
           "`\n\nWritten by `placegraph config --markdown`. Set them in a file (`--config`) or by "
           "`--set\n"
           "group.key=value`. Levels: basic (what most runs set), advanced (to adapt the system to "
           "other\ndata), internal (constants of an algorithm).\n" +
           options_markdown(all);
  return plain_list(entries);
}

std::string config(const ConfigArguments& arguments) {
  if (!arguments.out.empty()) require_free(arguments.out, arguments.force);
  require(arguments.of == "run" || arguments.of == "flight",
          "--of: '" + arguments.of + "' is none of run, flight");
  std::string text =
      arguments.of == "flight" ? config_of_flight(arguments) : config_of<RunOptions>(arguments);
  if (!arguments.out.empty()) write_file(arguments.out, text);
  return text;
}

}  // namespace placegraph::apps
