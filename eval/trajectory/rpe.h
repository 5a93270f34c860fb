#pragma once
#include <placegraph/eval/trajectory/frame_pair.h>
#include <placegraph/eval/trajectory/statistics.h>
#include <placegraph/graph/core/outcome.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Relative pose error over consecutive frames.
///
/// E = (T_i^-1 T_j)_truth^-1 (T_i^-1 T_j)_estimate.
struct RpeResult {
  Outcome outcome;           ///< kTooFewData if no two neighbours are posed
  Statistics translation_m;  ///< |trans E|; meaningful only if outcome
  Statistics rotation_deg;   ///< angle of E; its RMSE and its median are reported
};

/// Computes the relative pose error over every two neighbours that both have an estimate.
///
/// Sturm et al. 2012, section V.A, with delta = one frame. The angle is taken from the skew part as
/// well as the trace: acos of the trace alone cannot distinguish 0.02 deg from zero in matrices of
/// seven digits.
[[nodiscard]] RpeResult rpe(const std::vector<FramePair>& pairs);

/// Angle [rad], in [0, pi], of a rotation matrix that may be orthonormal to some digits only.
double rotation_angle(const Eigen::Matrix3d& R);

}  // namespace placegraph
