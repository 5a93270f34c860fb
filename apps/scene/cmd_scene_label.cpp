#include "apps/scene/cmd_scene_label.h"

#include <placegraph/frontend/labels/urban_labels.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/scene/scene_pictures.h"
#include "apps/support/scene_models.h"

namespace placegraph::apps {
namespace {

void label(const ScenePictureArguments& a) {
  const SceneModel urban = load_scene_model(SceneModel::Kind::kUrban, a.model);
  const SceneModel surfaces = load_scene_model(SceneModel::Kind::kSurfaces, a.surfaces_model);
  LabellerOptions options;
  options.relations = a.relations;
  label_pictures(a, urban.classes, [&](const SceneView& view) {
    return most_probable(label_urban(urban, surfaces, view, options).classes, urban.class_count(),
                         view, a.unknown_below);
  });
}

}  // namespace

void add_scene_label_command(CLI::App& scene) {
  CLI::App* command =
      scene.add_subcommand("label", "What each pixel of a street is: road, building, car, ...");
  command->footer("placegraph scene label camvid/val --out labels");
  auto arguments = std::make_shared<ScenePictureArguments>();
  add_scene_picture_options(*command, *arguments);
  command->add_option("--surfaces-model", arguments->surfaces_model,
                      "the model of surfaces that is asked too");
  command->callback([arguments] { label(*arguments); });
}

}  // namespace placegraph::apps
