#include "apps/run/cmd_inspect.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/run/inspect.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

void inspect_and_print(const InspectArguments& arguments, bool json) {
  const InspectResult result = inspect(arguments);
  print(json ? to_json(result) : to_text(result));
  if (result.unreadable && result.unreadable->count > 0)
    throw Error(fmt::format("{}; {} of {} frames cannot be read", result.unreadable->first,
                            result.unreadable->count, result.summary.frames));
}

}  // namespace

void add_inspect_command(CLI::App& app) {
  auto arguments = std::make_shared<InspectArguments>();
  auto json = std::make_shared<bool>(false);
  CLI::App* command =
      app.add_subcommand("inspect", "Show how a folder or video is read, and what `run` would use");
  command->footer("placegraph inspect kitti/sequences/00");
  command->add_option("PATH", arguments->path, "folder or video; see docs/datasets.md")
      ->type_name(kInput)
      ->required();
  command->add_flag("--read", arguments->read_all,
                    "read every image and count the unreadable ones");
  command->add_flag("--json", *json, kJsonText);
  command->callback([arguments, json] { inspect_and_print(*arguments, *json); });
}

}  // namespace placegraph::apps
