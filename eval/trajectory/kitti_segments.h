#pragma once
#include <placegraph/eval/trajectory/evaluation_options.h>
#include <placegraph/eval/trajectory/frame_pair.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/outcome.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// The error over one segment, divided by its nominal length.
struct SegmentError {
  int first_frame = 0, last_frame = 0;  ///< as FramePair::frame
  double length_m = 0;                  ///< nominal
  double t_percent = 0;
  double r_deg_per_100m = 0;
  double speed_m_per_s = 0;  ///< nominal length over the time from first to last frame
};

/// One row of a table: the mean over the segments of one length, or of one interval of speed.
struct SegmentGroup {
  double from = 0, to = 0;  ///< length [m] (both the same), or speed [m/s], from <= speed < to
  int segments = 0;
  double t_percent = 0;
  double r_deg_per_100m = 0;
};

struct SegmentResult {
  Outcome outcome;
  double t_rel_percent = 0;       ///< mean over all segments of all lengths; only if outcome
  double r_rel_deg_per_100m = 0;  ///< likewise
  std::vector<SegmentError> segments;
  std::vector<SegmentGroup> by_length, by_speed;  ///< rows with at least one segment
  int skipped = 0;                                ///< segments whose first or last frame is lost
};

/// Relative errors of the KITTI odometry devkit (Geiger et al. 2012): from every `step`-th frame i
/// and for every length L, j is the first frame with more than L metres of true path behind i, and
/// E = (T_i^-1 T_j)_estimate^-1 (T_i^-1 T_j)_truth gives |trans E| / L and
/// acos((tr R - 1) / 2) / L. Every segment weighs the same, whatever its length. Outcome:
/// kTooFewData if the path is too short for every length, or all segments were skipped.
/// `has_times` says whether stamp_ns are times or only indices.
[[nodiscard]] SegmentResult kitti_segments(const std::vector<FramePair>& pairs, bool has_times,
                                           const SegmentOptions& options);

/// Groups by length and by speed, as in the result.
std::vector<SegmentGroup> group_by_length(const std::vector<SegmentError>& segments);
std::vector<SegmentGroup> group_by_speed(const std::vector<SegmentError>& segments,
                                         double bin_m_per_s);

}  // namespace placegraph
