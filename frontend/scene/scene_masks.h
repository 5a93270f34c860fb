#pragma once
#include <placegraph/frontend/labels/scene_labeller.h>
#include <placegraph/frontend/scene/scene_options.h>
#include <placegraph/graph/core/options.h>

#include <array>

namespace placegraph {

/// Masks from the surfaces of an image, at the image's size.
struct SceneMasks {
  Image use;     ///< CV_8UC1, 0 = sky or objects that may move; empty if that leaves too little
  Image still;   ///< CV_8UC1, 0 = objects that may move; empty if `use` is
  Image ground;  ///< CV_8UC1, 0 = not ground; empty if it is switched off
};

/// Mean probabilities of the surfaces above and below the middle of an image.
struct SurfaceShares {
  std::array<double, kSurfaceCount> above{}, below{};
};

/// Computes the masks. `surfaces`: count x kSurfaceCount, the result of `classify_superpixels` with
/// a model of surfaces. Throws ArgumentError if the sizes do not agree.
SceneMasks mask_scene(const std::vector<float>& surfaces, const SceneView& view,
                      const SceneMaskOptions& options);
SurfaceShares surface_shares(const std::vector<float>& surfaces, const SceneView& view);

}  // namespace placegraph
