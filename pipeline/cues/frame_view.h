#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/geometry/line_segment.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Tracked features of one frame, for drawing and inspection.
///
/// Pixels are those of the (left) camera. All lists are empty for a frame that is lost.
struct FrameView {
  /// A tracked point.
  struct Track {
    LandmarkId id;                                          ///< id of the track and its landmark
    Eigen::Vector2d px = Eigen::Vector2d::Zero();           ///< pixel in this frame
    Eigen::Vector2d px_previous = Eigen::Vector2d::Zero();  ///< pixel in the previous frame
    /// Projection of the track's landmark [px]; nothing without a landmark or if it cannot be
    /// projected.
    std::optional<Eigen::Vector2d> px_projected;
    /// The landmark in the frame of the camera, in the scale of the track segment; nothing without
    /// a landmark.
    std::optional<Eigen::Vector3d> point_cam;
  };
  std::vector<Track> tracks;  ///< every tracked point, with or without a landmark
  /// A tracked straight edge.
  struct Line {
    LineId id;                 ///< id of the track and its landmark
    LineSegment segment;       ///< visible part in this frame [px]
    ImageLine::Carriers seen;  ///< two points that represent its infinite line
    /// Distance of the projected line landmark from the worse carrier [px]; nothing without a
    /// landmark.
    std::optional<double> off_px;
  };
  std::vector<Line> lines;  ///< empty where lines are not among the cues
  /// An edge that was examined for the directions of Manhattan frames.
  struct DirectedLine {
    LineSegment segment;  ///< segment in the image [px]
    std::optional<ManhattanFrameId>
        manhattan_frame;      ///< Manhattan frame to which the edge belongs, if any
    std::optional<int> axis;  ///< 0, 1 or 2: axis of that frame to which the edge is parallel
  };
  /// Edges of a keyframe; empty for other frames and where Manhattan frames are not among the cues.
  std::vector<DirectedLine> directed;
  /// A pixel of a plane that was aligned directly.
  struct SurfacePixel {
    Eigen::Vector2d px;          ///< pixel in this frame
    double residual_sigmas = 0;  ///< residual of its intensity, in standard deviations
  };
  std::vector<SurfacePixel> surfaces;  ///< empty where no planes are aligned
  /// Outline of the ground that is aligned for the scale; empty if the ground is not used.
  std::vector<Eigen::Vector2d> ground_px;
};

}  // namespace placegraph
