#include "apps/train/cmd_train.h"

#include <CLI/CLI.hpp>

#include "apps/train/cmd_train_environment.h"
#include "apps/train/cmd_train_planarity.h"
#include "apps/train/cmd_train_surfaces.h"
#include "apps/train/cmd_train_urban.h"

namespace placegraph::apps {

void add_train_commands(CLI::App& train) {
  add_train_surfaces_command(train);
  add_train_urban_command(train);
  add_train_planarity_command(train);
  add_train_environment_command(train);
}

}  // namespace placegraph::apps
