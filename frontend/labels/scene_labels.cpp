#include <placegraph/frontend/labels/scene_labeller.h>
#include <placegraph/frontend/labels/scene_labels.h>

namespace placegraph {

SceneLabels label_scene(const SceneModel& model, const Image& picture, double unknown_below,
                        const LabellerOptions& options) {
  const SceneView view = view_scene(picture);
  return most_probable(classify_superpixels(model, view, options), model.class_count(), view,
                       unknown_below);
}

}  // namespace placegraph
