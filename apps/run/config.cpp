#include "apps/run/config.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/config/yaml_config.h>
#include <placegraph/pipeline/internal/flight/flight_estimator.h>
#include <placegraph/pipeline/run.h>

#include <algorithm>

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

/// The options as they stand after the file and the settings, in the form asked for.
template <class Options>
std::string text_of(const ConfigArguments& arguments) {
  Options options;
  if (!arguments.config.empty()) read_options(arguments.config, options);
  for (const std::string& setting : arguments.settings) set_option(options, setting);
  options.check();
  if (arguments.form == ConfigForm::kYaml) return dump_options(options);
  if (arguments.form == ConfigForm::kMarkdown)
    return "# Options of `placegraph " + arguments.of +
           "`\n\nWritten by `placegraph config --markdown`; set them in a file (`--config`) or by "
           "`--set key=value`.\n\n" +
           options_markdown(options);
  return plain_list(list_options(options));
}

}  // namespace

std::string config(const ConfigArguments& arguments) {
  if (!arguments.out.empty()) require_free(arguments.out, arguments.force);
  require(arguments.of == "run" || arguments.of == "flight",
          "--of: '" + arguments.of + "' is none of run, flight");
  std::string text =
      arguments.of == "flight" ? text_of<FlightOptions>(arguments) : text_of<RunOptions>(arguments);
  if (!arguments.out.empty()) write_file(arguments.out, text);
  return text;
}

}  // namespace placegraph::apps
