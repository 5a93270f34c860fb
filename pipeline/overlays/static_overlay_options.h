#pragma once
#include <placegraph/graph/core/options.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Search for static overlays, which move with the camera and are no part of the world.
///
/// Dirt on the lens, a time stamp, a logo or the bonnet are such. An episode is a stretch of frames
/// in which the camera moves. It speaks against a patch that stands still in the images if the
/// motion of other points moves every point of the world there, however far away.
struct StaticOverlayOptions {
  bool enabled = true;  ///< search for static overlays and mask them
  void check() const;
};
void visit(OptionVisitor& field, StaticOverlayOptions& options);

}  // namespace placegraph
