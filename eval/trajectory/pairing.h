#pragma once
#include <placegraph/eval/trajectory/evaluation_options.h>
#include <placegraph/eval/trajectory/frame_pair.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/trajectory.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

std::string to_string(Association association);  ///< "auto", "index", "time"

/// Which line of the estimate belongs to which of the ground truth.
struct PairingResult {
  Outcome outcome;
  Association association = Association::kAuto;  ///< the one used, kIndex or kTime
  /// The frames to judge, in time order: posed lines of the ground truth that the estimate has a
  /// pose of, or should have one and is lost. By time, a line without a partner counts as lost only
  /// where no pose of the estimate is within three quarters of the estimate's spacing; where the
  /// ground truth is clearly denser (a motion capture system at 200 Hz), one per missing pose.
  std::vector<FramePair> pairs;
  bool has_times = false;             ///< FramePair::stamp_ns are times
  bool has_orientation = true;        ///< on both sides
  int truth_frames = 0;               ///< posed lines of the ground truth
  int posed = 0;                      ///< pairs with an estimate
  int estimate_frames = 0;            ///< posed lines of the estimate
  int estimate_without_truth = 0;     ///< of those, without a posed partner
  std::vector<std::string> warnings;  ///< what is odd about the times of either
};

/// Pairs two trajectories, or says in `outcome` why it would be a guess: lines of different number
/// without times, times on one side only, stamps that do not overlap, fewer than two pairs
/// (kTooFewData or kInconsistent). Throws ArgumentError if stamps of either do not increase.
[[nodiscard]] PairingResult pair_trajectories(const Trajectory& truth, const Trajectory& estimate,
                                              Association association,
                                              const AssociationOptions& options);

}  // namespace placegraph
