#include "apps/image/scene/scene_label.h"

#include <placegraph/frontend/labels/street_labels.h>

#include <memory>

#include "apps/image/scene/street_images.h"
#include "apps/shipped/scene_models.h"
#include "apps/support/output.h"

namespace placegraph::apps {

SceneImageResult scene_label(const SceneImageArguments& a) {
  const SceneModel urban = load_scene_model(SceneModel::Kind::kUrban, a.model);
  const auto surfaces = std::make_shared<const SceneModel>(
      load_scene_model(SceneModel::Kind::kSurfaces, a.surfaces_model));
  LabellerOptions options;
  options.relations = a.relations;
  const std::vector<std::string> images = image_paths_of(a.input);
  std::vector<double> street(images.size(), 1);
  // Kinds of environments are known by the surfaces of the installed model, and other models may
  // have classes that are not of streets.
  if (a.surroundings != "street" && a.model.empty() && a.surfaces_model.empty()) {
    require_free_folder(a.out, a.force);
    street = street_probabilities(images, surfaces, a.surroundings == "sequence", a.threads);
  }
  return label_images(a, urban.classes, [&](std::size_t image, const Image& picture) {
    return label_street_scene(urban, *surfaces, picture, street.at(image), a.unknown_below, options)
        .classes;
  });
}

}  // namespace placegraph::apps
