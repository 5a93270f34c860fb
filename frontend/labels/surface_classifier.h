#pragma once
#include <placegraph/frontend/labels/scene_labeller.h>

namespace placegraph {

/// Sky, ground, verticals and objects of one image, at its size.
struct SurfaceLayout {
  SceneLabels surfaces;  ///< Surface as a number; kSurfaceCount where unknown
  Image ground;          ///< mask CV_8UC1, 255 for ground
};

/// Classifies the surfaces of an image by a model of kind kSurfaces.
///
/// Throws ArgumentError for another model or an image that `view_scene` refuses.
SurfaceLayout classify_surfaces(const SceneModel& model, const SceneView& view,
                                double unknown_below = 0, const LabellerOptions& options = {});

/// Mask of the pixels of one surface.
Image surface_mask(const Image& labels, Surface surface);

}  // namespace placegraph
