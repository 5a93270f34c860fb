#pragma once
#include <placegraph/eval/association/frame_pair.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/outcome.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Segments of the relative errors t_rel and r_rel; the defaults are those of KITTI.
struct SegmentOptions {
  /// Lengths of the segments along the true path.
  std::vector<double> lengths_m = {100, 200, 300, 400, 500, 600, 700, 800};
  int step = 10;                 ///< frames between the starts of two segments
  double frame_rate_hz = 10;     ///< frame rate for speeds, if the ground truth has no times
  double speed_bin_m_per_s = 2;  ///< width of an interval of speed in the table per speed
  void check() const;
};
void visit(OptionVisitor& field, SegmentOptions& options);

/// The error over one segment, divided by its nominal length.
struct SegmentError {
  int first_frame = 0, last_frame = 0;  ///< as FramePair::frame
  double length_m = 0;                  ///< nominal, one of SegmentOptions::lengths_m
  double t_percent = 0;                 ///< error in translation over the length [%]
  double r_deg_per_100m = 0;            ///< error in rotation over the length
  double speed_m_per_s = 0;             ///< nominal length over the time from first to last frame
};

/// One row of a table: the mean over the segments of one length, or of one interval of speed.
struct SegmentGroup {
  double from = 0, to = 0;    ///< length [m] (both the same), or speed [m/s], from <= speed < to
  int segments = 0;           ///< number of segments in the mean
  double t_percent = 0;       ///< mean error in translation [%]
  double r_deg_per_100m = 0;  ///< mean error in rotation
};

/// Relative errors over all segments of a trajectory.
struct SegmentResult {
  Outcome outcome;                     ///< kTooFewData if there is no segment
  double t_rel_percent = 0;            ///< mean over all segments of all lengths; only if outcome
  double r_rel_deg_per_100m = 0;       ///< likewise
  std::vector<SegmentError> segments;  ///< by first frame, then in the order of the lengths
  std::vector<SegmentGroup> by_length, by_speed;  ///< rows with at least one segment
  int skipped = 0;                                ///< segments whose first or last frame is lost
};

/// Computes the relative errors of the KITTI odometry devkit (Geiger et al. 2012).
///
/// From every `step`-th frame i and for every length L, j is the first frame with more than L
/// metres of true path behind i, and E = (T_i^-1 T_j)_estimate^-1 (T_i^-1 T_j)_truth yields |trans
/// E| / L and acos((tr R - 1) / 2) / L. Every segment has the same weight, independent of its
/// length. Outcome: kTooFewData if the path is too short for every length, or all segments were
/// skipped. `has_times` says whether stamp_ns are times or only indices. Positions of the estimate
/// are multiplied by `scale`. Throws ArgumentError for options that check() refuses.
[[nodiscard]] SegmentResult kitti_segments(const std::vector<FramePair>& pairs, bool has_times,
                                           const SegmentOptions& options, double scale = 1);

/// Means of the segments of each nominal length, by ascending length.
std::vector<SegmentGroup> group_by_length(const std::vector<SegmentError>& segments);
/// Means of the segments of each interval of speed that has any, by ascending speed.
std::vector<SegmentGroup> group_by_speed(const std::vector<SegmentError>& segments,
                                         double bin_m_per_s);

}  // namespace placegraph
