#pragma once
#include <placegraph/graph/image/image.h>
#include <placegraph/graph/internal/core/random.h>

#include <cstdint>

namespace placegraph {

/// A labelled picture as another day, another light and another camera might have shown it.
struct SceneVariant {
  Image bgr, labels;
};

/// Draws exposure, contrast, colour of the light, clouds and shadows (smooth factors), noise of the
/// sensor, zoom and shift, takes the colour from about a third, and mirrors where `mirror` says so.
/// `labels` of type CV_8UC1; pixels that come from outside become `void_label`. The same `random`
/// gives the same picture.
SceneVariant vary_scene(const Image& bgr, const Image& labels, std::uint8_t void_label, bool mirror,
                        Random& random);

}  // namespace placegraph
