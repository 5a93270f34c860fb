#pragma once
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/geometry/line_segment.h>
#include <placegraph/graph/geometry/se3.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Consistency of the observations of a line track.
struct TrackConsistency {
  bool judged = false;       ///< false: its planes hardly rotated, any association would fit
  std::vector<bool> of_one;  ///< per observation: whether it shows the line of the majority
  int wrong() const;         ///< number of observations of other lines
};

/// Determines which observations of a track show one line of a static scene, for exact poses.
///
/// `T_ref_cam` and `seen`: the pose of the camera and the image line [px] of each observation, as
/// many of both (ArgumentError). /// The line is the intersection of the planes of two observations
/// with which most others agree within `max_error_px` at both carriers, in front of them. Pairs are
/// taken from at most `kept` observations, evenly spaced. All count as one line if there are fewer
/// than three or no two planes at an angle of 0.05 degrees.
[[nodiscard]] TrackConsistency judge_line_track(const Camera& camera,
                                                const std::vector<SE3>& T_ref_cam,
                                                const std::vector<ImageLine::Carriers>& seen,
                                                double max_error_px = 3, int kept = 12);

}  // namespace placegraph
