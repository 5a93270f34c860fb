#pragma once
#include <placegraph/graph/core/options.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Search for static overlays, which move with the camera and are no part of the world.
///
/// Dirt on the lens, a time stamp, a logo or the bonnet are such. An episode is a stretch of frames
/// in which the camera moves. It speaks against a patch that stands still in the images if the
/// motion of other points moves every point of the world there, however far away.
struct StaticOverlayOptions {
  bool enabled = true;       ///< search for static overlays and mask them
  int interval = 2;          ///< number of frames from one comparison of the patches to the next
  double standing_px = 0.3;  ///< maximum displacement of a patch that stands still [px]
  double min_motion_px = 8;  ///< displacement of most moving points that completes an episode [px]
  /// Minimum distance from a patch that stands still to the nearest pixel at which the motion
  /// allows it [px].
  double min_contradiction_px = 0.5;
  int min_episodes = 2;  ///< number of episodes that prove a patch to move with the camera
  int min_patches = 6;   ///< minimum number of proven patches in a region that is masked
  void check() const;
};
void visit(OptionVisitor& field, StaticOverlayOptions& options);

}  // namespace placegraph
