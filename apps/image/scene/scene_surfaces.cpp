#include "apps/image/scene/scene_surfaces.h"

#include <placegraph/frontend/labels/surface_classifier.h>

#include "apps/shipped/scene_models.h"

namespace placegraph::apps {

SceneImageResult scene_surfaces(const SceneImageArguments& a) {
  const SceneModel model = load_scene_model(SceneModel::Kind::kSurfaces, a.model);
  LabellerOptions options;
  options.relations = a.relations;
  return label_images(a, model.classes, [&](std::size_t, const SceneView& view) {
    return classify_surfaces(model, view, a.unknown_below, options).surfaces;
  });
}

}  // namespace placegraph::apps
