#include "apps/train/cmd_train_surfaces.h"

#include "apps/train/cmd_train_scene.h"

namespace placegraph::apps {

void add_train_surfaces_command(CLI::App& train) {
  add_train_scene_command(
      train, SceneModel::Kind::kSurfaces,
      "Train the model of surfaces (sky, ground, vertical, object) on labelled images");
}

}  // namespace placegraph::apps
