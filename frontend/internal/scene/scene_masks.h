#pragma once
#include <placegraph/frontend/internal/labels/scene_labeller.h>
#include <placegraph/frontend/scene/scene_options.h>
#include <placegraph/graph/core/options.h>

#include <array>

namespace placegraph {

/// What the surfaces of a picture allow, images of the picture's size.
struct SceneMasks {
  Image use;     ///< CV_8UC1, 0 = sky or what may move; empty if that leaves too little
  Image still;   ///< CV_8UC1, 0 = what may move; empty as `use` is
  Image ground;  ///< CV_8UC1, 0 = not ground; empty if it is not asked for
};

/// Mean probabilities of the surfaces above and below the middle of a picture.
struct SurfaceShares {
  std::array<double, kSurfaceCount> above{}, below{};
};

/// `surfaces`: count x kSurfaceCount, as `classify_superpixels` tells with a model of surfaces.
/// Throws ArgumentError if the sizes do not agree.
SceneMasks mask_scene(const std::vector<float>& surfaces, const SceneView& view,
                      const SceneMaskOptions& options);
SurfaceShares surface_shares(const std::vector<float>& surfaces, const SceneView& view);

}  // namespace placegraph
