#pragma once
#include <placegraph/frontend/labels/scene_labels.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Labels of an image by street classes and by surfaces.
struct StreetLabels {
  SceneLabels classes;   ///< by the classes of the urban model
  SceneLabels surfaces;  ///< by Surface
};

/// Labels the pixels of an image by the street classes and the surfaces of two models.
///
/// Every class is one surface (a road is ground and never upright): each model helps the other.
/// `street` is the probability that the image shows a street at all: a pixel has no class where
/// none is the most probable. Surfaces do not depend on it. Otherwise as label_scene; throws
/// ArgumentError also for models of other kinds and a `street` outside of 0 to 1.
StreetLabels label_street_scene(const SceneModel& urban, const SceneModel& surfaces,
                                const Image& picture, double street = 1, double unknown_below = 0,
                                const LabellerOptions& options = {});

}  // namespace placegraph
