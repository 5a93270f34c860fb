#include <placegraph/frontend/labels/joint_labels.h>
#include <placegraph/frontend/labels/street_labels.h>

namespace placegraph {

StreetLabels label_street_scene(const SceneModel& urban, const SceneModel& surfaces,
                                const Image& picture, double street, double unknown_below,
                                const LabellerOptions& options) {
  const SceneView view = view_scene(picture);
  const JointLabels found = label_jointly(urban, surfaces, view, options);
  return {street_labels(found.classes, urban.class_count(), view, street, unknown_below),
          most_probable(found.surfaces, surfaces.class_count(), view, unknown_below)};
}

}  // namespace placegraph
