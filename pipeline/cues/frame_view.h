#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/geometry/line_segment.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// What the frontend sees in one frame, for drawing and inspection.
///
/// Pixels are those of the (left) camera. All lists are empty for a frame that is lost.
struct FrameView {
  /// A tracked point.
  struct Track {
    LandmarkId id;                                          ///< of the track and its landmark
    Eigen::Vector2d px = Eigen::Vector2d::Zero();           ///< in this frame
    Eigen::Vector2d px_previous = Eigen::Vector2d::Zero();  ///< in the frame before
    /// Projection of the track's landmark [px]; nothing without a landmark or if it cannot be
    /// projected.
    std::optional<Eigen::Vector2d> px_projected;
  };
  std::vector<Track> tracks;  ///< every tracked point, with or without a landmark
  /// A tracked straight edge.
  struct Line {
    LineId id;                 ///< of the track and its landmark
    LineSegment segment;       ///< its visible part in this frame [px]
    ImageLine::Carriers seen;  ///< two points that stand for its infinite line
    /// Distance of the projected line landmark from the worse carrier [px]; nothing without one.
    std::optional<double> off_px;
  };
  std::vector<Line> lines;  ///< empty where lines are not among the cues
  /// An edge that was examined for the directions of Manhattan frames.
  struct DirectedLine {
    LineSegment segment;                    ///< [px]
    std::optional<ManhattanFrameId> world;  ///< the frame that it belongs to, if any
    std::optional<int> axis;                ///< 0, 1 or 2: the axis of that frame it lies along
  };
  /// Of keyframes only, and only where Manhattan frames are among the cues.
  std::vector<DirectedLine> directed;
  /// A pixel of a plane that was aligned directly.
  struct SurfacePixel {
    Eigen::Vector2d px;          ///< in this frame
    double residual_sigmas = 0;  ///< residual of its grey value, in standard deviations
  };
  std::vector<SurfacePixel> surfaces;  ///< empty where no planes are aligned
  /// Outline of the ground that is aligned for the scale; empty if it is not looked at.
  std::vector<Eigen::Vector2d> ground_px;
};

}  // namespace placegraph
