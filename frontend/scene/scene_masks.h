#pragma once
#include <placegraph/frontend/labels/scene_labeller.h>
#include <placegraph/graph/core/options.h>

#include <array>

namespace placegraph {

/// What labels of surfaces keep out of tracking and of place cues, and where they let the ground be
/// looked at. A label counts where it is this probable; elsewhere the picture is used as it is.
struct SceneMaskOptions {
  bool sky = true;       ///< nothing is looked for in the sky
  bool moving = true;    ///< nor on what may move: cars, people, bicycles
  bool ground = true;    ///< the road is measured only where it is ground
  double min_sky = 0.9;  ///< overexposed walls pass for sky below that
  double min_moving = 0.6;
  double min_ground = 0.5;
  int margin_px = 4;        ///< about what may move: its contour moves too
  double min_share = 0.25;  ///< of the picture that must be left, otherwise no mask is used
  void check() const;
};
void visit(OptionVisitor& field, SceneMaskOptions& options);

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
