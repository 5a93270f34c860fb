#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/geometry/trajectory.h>
#include <placegraph/graph/map.h>

#include <optional>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// What a loop constraint may differ from the truth by and still be a true one.
struct LoopCheckOptions {
  double max_translation_m = 0.1;
  double max_rotation_deg = 5;
  int min_frames_apart = 33;  ///< constraints between nearer frames count as neither
  void check() const;
};
void visit(OptionVisitor& field, LoopCheckOptions& options);

/// An accepted loop against the true relative pose.
struct CheckedLoop {
  FrameId query_frame, match_frame;
  double translation_error_m = 0;
  double rotation_error_deg = 0;
  bool correct = false;
};

struct LoopCheck {
  std::vector<CheckedLoop> loops;  ///< the accepted ones that could be judged, in their order
  int correct = 0, wrong = 0;
  int too_near = 0;  ///< accepted ones nearer than min_frames_apart
  int unjudged = 0;  ///< accepted ones without ground truth at one of their frames
};

/// Judges accepted loops by E = (T_match_query)_truth^-1 (T_match_query)_measured. `truth` has one
/// line per frame of the sequence, indexed by LoopRecord's frames. Measured poses must be metric.
LoopCheck check_loops(const Trajectory& truth, const std::vector<LoopRecord>& loops,
                      const LoopCheckOptions& options);

}  // namespace placegraph
