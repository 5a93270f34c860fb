#include "apps/train/cmd_train_urban.h"

#include "apps/train/cmd_train_scene.h"

namespace placegraph::apps {

void add_train_urban_command(CLI::App& train) {
  add_train_scene_command(train, SceneModel::Kind::kUrban,
                          "Train the model of street classes on labelled images");
}

}  // namespace placegraph::apps
