#include "apps/image/scene/scene_surfaces.h"

#include <placegraph/frontend/labels/scene_labels.h>

#include "apps/shipped/scene_models.h"

namespace placegraph::apps {

SceneImageResult scene_surfaces(const SceneImageArguments& a) {
  const SceneModel model = load_scene_model(SceneModel::Kind::kSurfaces, a.model);
  LabellerOptions options;
  options.relations = a.relations;
  return label_images(a, model.classes, [&](std::size_t, const Image& picture) {
    return label_scene(model, picture, a.unknown_below, options);
  });
}

}  // namespace placegraph::apps
