#include "apps/scene/cmd_scene_surfaces.h"

#include <placegraph/frontend/labels/surface_classifier.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/scene/scene_pictures.h"
#include "apps/support/scene_models.h"

namespace placegraph::apps {
namespace {

void find_surfaces(const ScenePictureArguments& a) {
  const SceneModel model = load_scene_model(SceneModel::Kind::kSurfaces, a.model);
  LabellerOptions options;
  options.relations = a.relations;
  label_pictures(a, model.classes, [&](const SceneView& view) {
    return classify_surfaces(model, view, a.unknown_below, options).surfaces;
  });
}

}  // namespace

void add_scene_surfaces_command(CLI::App& scene) {
  CLI::App* command = scene.add_subcommand(
      "surfaces", "Sky 0, ground 1, vertical 2 or object 3: each pixel of a picture");
  command->footer("placegraph scene surfaces camvid/val --out surfaces");
  auto arguments = std::make_shared<ScenePictureArguments>();
  add_scene_picture_options(*command, *arguments);
  command->callback([arguments] { find_surfaces(*arguments); });
}

}  // namespace placegraph::apps
