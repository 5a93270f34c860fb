#pragma once
#include <placegraph/eval/trajectory/frame_pair.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/trajectory.h>

#include <string>
#include <vector>

namespace placegraph {

enum class Association {
  kAuto,   ///< by time if both have times, by index if neither has; otherwise refused
  kIndex,  ///< line i with line i; both must be of the same length
  kTime,   ///< nearest stamps
};

std::string to_string(Association association);  ///< "auto", "index", "time"

/// Which line of the estimate belongs to which of the ground truth.
struct PairingResult {
  Outcome outcome;
  Association association = Association::kAuto;  ///< the one used, kIndex or kTime
  /// The frames to judge, in time order: every posed line of the ground truth, lost ones among
  /// them. Where the ground truth has several lines per line of the estimate (a motion capture
  /// system at 200 Hz), it is thinned to the associated ones, and one per missing frame.
  std::vector<FramePair> pairs;
  bool has_times = false;  ///< FramePair::stamp_ns are times
  int truth_frames = 0;    ///< posed lines of the ground truth, before thinning
  int posed = 0;           ///< pairs with an estimate
  bool thinned = false;
};

/// Pairs two trajectories, or says in `outcome` why it would be a guess: lines of different number
/// without times, times on one side only, stamps that do not overlap, fewer than two pairs
/// (kTooFewData or kInconsistent). Throws ArgumentError if stamps of either do not increase.
[[nodiscard]] PairingResult pair_trajectories(const Trajectory& truth, const Trajectory& estimate,
                                              Association association,
                                              const AssociationOptions& options);

}  // namespace placegraph
