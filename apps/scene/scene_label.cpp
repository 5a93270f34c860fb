#include "apps/scene/scene_label.h"

#include <placegraph/frontend/internal/labels/urban_labels.h>

#include "apps/shipped/scene_models.h"

namespace placegraph::apps {

SceneImageResult scene_label(const SceneImageArguments& a) {
  const SceneModel urban = load_scene_model(SceneModel::Kind::kUrban, a.model);
  const SceneModel surfaces = load_scene_model(SceneModel::Kind::kSurfaces, a.surfaces_model);
  LabellerOptions options;
  options.relations = a.relations;
  return label_images(a, urban.classes, [&](const SceneView& view) {
    return most_probable(label_urban(urban, surfaces, view, options).classes, urban.class_count(),
                         view, a.unknown_below);
  });
}

}  // namespace placegraph::apps
