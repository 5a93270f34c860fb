#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/geometry/line_segment.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// What the frontend sees in one frame, for drawing and looking on; pixels of the (left) eye.
/// Nothing in a frame that is lost.
struct FrameView {
  struct Track {
    LandmarkId id;
    Eigen::Vector2d px = Eigen::Vector2d::Zero();
    Eigen::Vector2d px_previous = Eigen::Vector2d::Zero();  ///< in the frame before
    /// Where the landmark of this track projects to, if the track has one and the frame a pose.
    std::optional<Eigen::Vector2d> px_projected;
  };
  std::vector<Track> tracks;
  struct Line {
    LineId id;
    LineSegment segment;       ///< its support in this frame
    ImageLine::Carriers seen;  ///< its infinite line
    /// How far off, at the worse carrier, the line of the window is projected [px], if it has one.
    std::optional<double> off_px;
  };
  std::vector<Line> lines;
  /// An edge that was looked at for the directions of rectangular worlds.
  struct DirectedLine {
    LineSegment segment;
    std::optional<ManhattanFrameId> world;
    std::optional<int> axis;  ///< of that world; nothing: it lies along none
  };
  /// Of keyframes only, where those directions are among the cues.
  std::vector<DirectedLine> directed;
  struct SurfacePixel {
    Eigen::Vector2d px;
    double residual_sigmas = 0;  ///< of its grey value
  };
  std::vector<SurfacePixel> surfaces;  ///< pixels of planes that were aligned
  /// Outline of the ground that is aligned for the scale; empty if it is not looked at.
  std::vector<Eigen::Vector2d> ground_px;
};

}  // namespace placegraph
