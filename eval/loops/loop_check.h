#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/geometry/trajectory.h>
#include <placegraph/graph/map.h>

#include <optional>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Largest errors of a loop constraint that counts as correct.
struct LoopCheckOptions {
  double max_translation_m = 0.1;  ///< largest error in translation
  double max_rotation_deg = 5;     ///< largest error in rotation
  int min_frames_apart = 33;  ///< constraints between nearer frames are neither correct nor wrong
  void check() const;
};
void visit(OptionVisitor& field, LoopCheckOptions& options);

/// An accepted loop, compared with the true relative pose.
struct CheckedLoop {
  FrameId query_frame, match_frame;  ///< the newer and the older frame of the loop
  double translation_error_m = 0;    ///< |trans E|, see check_loops
  double rotation_error_deg = 0;     ///< angle of E
  bool correct = false;              ///< both errors are within the options
};

/// How many accepted loops of a run are correct.
struct LoopCheck {
  std::vector<CheckedLoop> loops;  ///< accepted loops with ground truth, in their order
  int correct = 0, wrong = 0;      ///< numbers of correct and wrong loops
  int too_near = 0;                ///< accepted loops of frames nearer than min_frames_apart
  int unjudged = 0;                ///< accepted loops without ground truth at one of their frames
};

/// Judges accepted loops by E = (T_match_query)_truth^-1 (T_match_query)_measured.
///
/// `truth` has one pose T_world_cam per frame of the sequence, indexed by the frames of LoopRecord.
/// Measured poses must be metric. Loops that are not accepted are ignored.
LoopCheck check_loops(const Trajectory& truth, const std::vector<LoopRecord>& loops,
                      const LoopCheckOptions& options);

}  // namespace placegraph
