#pragma once
#include <placegraph/frontend/scene/scene_masks.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/geometry/line_segment.h>
#include <placegraph/graph/image/frame.h>

#include <memory>

namespace placegraph {

/// Labels of the surfaces in a keyframe's image.
struct SurfaceLabels {
  FrameId frame;
  SceneMasks masks;  ///< empty images where no masks are requested or the labels are not trusted
  SurfaceShares shares;
};

/// Labels the surfaces of images for odometry, place recognition and environment classification. An
/// image costs some 80 ms.
class SurfaceLabeller {
 public:
  /// `surfaces`: a model of kind kSurfaces (ArgumentError otherwise), which must not be null.
  SurfaceLabeller(std::shared_ptr<const SceneModel> surfaces, const SceneMaskOptions& options);
  /// Labels a frame, in colour if it has it. `masks`: whether masks are requested.
  SurfaceLabels label(const Frame& frame, bool masks) const;

 private:
  std::shared_ptr<const SceneModel> surfaces_;
  SceneMaskOptions options_;
};

/// Straight edges of an image for EnvironmentEvidence, detected in the image reduced to a width of
/// at most 640 pixels, and the camera that corresponds to it.
std::pair<std::vector<LineSegment>, Camera> edges_of(const Image& grey, const Camera& camera);

}  // namespace placegraph
