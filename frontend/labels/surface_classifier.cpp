#include <placegraph/frontend/labels/surface_classifier.h>
#include <placegraph/graph/core/error.h>

namespace placegraph {

SurfaceLayout classify_surfaces(const SceneModel& model, const SceneView& view,
                                double unknown_below, const LabellerOptions& options) {
  require(model.kind == SceneModel::Kind::kSurfaces && model.class_count() == kSurfaceCount,
          "classify_surfaces: needs a model of surfaces");
  SurfaceLayout layout;
  layout.surfaces =
      most_probable(classify_superpixels(model, view, options), kSurfaceCount, view, unknown_below);
  layout.ground = surface_mask(layout.surfaces.labels, Surface::kGround);
  return layout;
}

Image surface_mask(const Image& labels, Surface surface) {
  return labels == static_cast<int>(surface);
}

}  // namespace placegraph
