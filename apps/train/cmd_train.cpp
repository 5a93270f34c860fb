#include "apps/train/cmd_train.h"

#include <CLI/CLI.hpp>

#include "apps/train/cmd_train_environment.h"
#include "apps/train/cmd_train_planarity.h"
#include "apps/train/cmd_train_surfaces.h"
#include "apps/train/cmd_train_urban.h"

namespace placegraph::apps {

void add_train_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("train", "Learn the models that come with the program");
  command->footer("placegraph train urban camvid --out urban.pgscene");
  command->require_subcommand(1);
  add_train_surfaces_command(*command);
  add_train_urban_command(*command);
  add_train_planarity_command(*command);
  add_train_environment_command(*command);
}

}  // namespace placegraph::apps
