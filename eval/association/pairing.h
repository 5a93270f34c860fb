#pragma once
#include <placegraph/eval/association/frame_pair.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/trajectory.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// How poses of the estimate are paired with poses of the ground truth.
enum class Association {
  kAuto,   ///< by time if both have times, by index if neither has; otherwise refused
  kIndex,  ///< frames of the same number: line i with line i, both of the same length, unless the
           ///< files number their frames
  kTime,   ///< nearest stamps
};

/// Name of an association: "auto", "index" or "time".
std::string to_string(Association association);

/// Which pose of the estimate belongs to which pose of the ground truth.
struct PairingResult {
  Outcome outcome;                               ///< see pair_trajectories
  Association association = Association::kAuto;  ///< the one used, kIndex or kTime
  /// The frames to evaluate, in time order: posed lines of the ground truth for which the estimate
  /// has a pose, or lacks one that it should have. By time, a line without a partner counts as lost
  /// only where no pose of the estimate is within three quarters of the estimate's spacing; where
  /// the ground truth is clearly denser (a motion capture system at 200 Hz), one per missing pose.
  std::vector<FramePair> pairs;
  bool has_times = false;             ///< FramePair::stamp_ns are times, not indices
  bool has_orientation = true;        ///< both trajectories have orientations
  int truth_frames = 0;               ///< posed lines of the ground truth
  int posed = 0;                      ///< pairs with an estimate
  int estimate_frames = 0;            ///< posed lines of the estimate
  int estimate_without_truth = 0;     ///< posed lines of the estimate without a posed partner
  /// Those of them whose nearest true pose is near enough, but is the partner of a nearer pose.
  int estimate_beside_nearer = 0;
  /// Those of their readers, implausible times of either, holes in the truth.
  std::vector<std::string> warnings;
};

/// Pairs the poses of two trajectories, or states in `outcome` why the pairs are ambiguous.
///
/// kInconsistent: different numbers of lines without times, times on one side only, stamps that do
/// not overlap, or of which most of both find no partner in the time that both cover: figures of a
/// few lucky pairs would say nothing. kTooFewData: fewer than two pairs. Throws ArgumentError if
/// stamps of either do not increase.
[[nodiscard]] PairingResult pair_trajectories(const Trajectory& truth, const Trajectory& estimate,
                                              Association association,
                                              const AssociationOptions& options);

}  // namespace placegraph
