#pragma once
#include <placegraph/frontend/internal/scene/environment.h>
#include <placegraph/frontend/internal/scene/scene_masks.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/image/frame.h>

#include <memory>

namespace placegraph {

/// What the surfaces of a keyframe's picture are good for.
struct SurfaceLabels {
  FrameId frame;
  SceneMasks masks;  ///< empty images where no masks are wanted or the labels are not trusted
  SurfaceShares shares;
};

/// Labels the surfaces of pictures for motion, places and context. A picture costs some 80 ms.
class SurfaceLabeller {
 public:
  /// `surfaces`: a model of kind kSurfaces (ArgumentError otherwise), which must not be null.
  SurfaceLabeller(std::shared_ptr<const SceneModel> surfaces, const SceneMaskOptions& options);
  /// In colour where the frame has it. `masks`: whether they are wanted.
  SurfaceLabels look(const Frame& frame, bool masks) const;

 private:
  std::shared_ptr<const SceneModel> surfaces_;
  SceneMaskOptions options_;
};

/// The straight edges of a picture for EnvironmentEvidence, from the picture shrunk to at most 640
/// pixels across, with the camera they belong to.
std::pair<std::vector<LineSegment>, Camera> edges_of(const Image& grey, const Camera& camera);

}  // namespace placegraph
