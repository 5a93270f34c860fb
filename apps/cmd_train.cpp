#include "apps/cmd_train.h"

#include <CLI/CLI.hpp>

#include "apps/train_planarity.h"

namespace placegraph::apps {

void add_train_command(CLI::App& app) {
  CLI::App* train = app.add_subcommand("train", "Learn the models that come with the library");
  train->footer("placegraph train planarity --out planarity.txt");
  train->require_subcommand(1);
  add_train_planarity(*train);
}

}  // namespace placegraph::apps
