#include "apps/viewer/cmd_view.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/server/cmd_viewer_options.h"
#include "apps/support/option_texts.h"
#include "apps/viewer/view.h"

namespace placegraph::apps {

void add_view_command(CLI::App& app) {
  auto arguments = std::make_shared<ViewArguments>();
  arguments->program = "placegraph " PLACEGRAPH_VERSION;
  CLI::App* command =
      app.add_subcommand("view", "Show runs in a browser, with all images, and edit their loops");
  command->footer("placegraph view out/town-run --open");
  command
      ->add_option("RUN", arguments->runs, "folders that `placegraph run` wrote, or their map.db")
      ->type_name(kInput)
      ->required();
  add_viewer_options(*command, arguments->viewer);
  command->callback([arguments] { view(*arguments); });
}

}  // namespace placegraph::apps
