#pragma once
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/image/image.h>

#include <cstdint>

namespace placegraph {

/// Labelled image as on another day, in another light and with another camera.
struct SceneVariant {
  Image bgr, labels;
};

/// Simulates other conditions for an image.
///
/// Random exposure, contrast, colour of the light, clouds and shadows (smooth factors), sensor
/// noise, zoom and shift; about a third lose their colour; mirrored if `mirror` is set. `labels`
/// has type CV_8UC1; pixels from outside the image become `void_label`. The same `random` gives the
/// same image.
SceneVariant vary_scene(const Image& bgr, const Image& labels, std::uint8_t void_label, bool mirror,
                        Random& random);

}  // namespace placegraph
