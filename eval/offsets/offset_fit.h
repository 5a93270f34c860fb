#pragma once
#include <placegraph/eval/offsets/offset_equations.h>
#include <placegraph/graph/core/outcome.h>

namespace placegraph {

/// A fit of the parameters that a mask names.
struct OffsetFit {
  Outcome outcome;  ///< kTooFewData; kNotConverged
  OffsetState state;
  /// Of the parameters, in the tangent of T_estimate_truth; none along directions that are free.
  OffsetMatrix covariance = OffsetMatrix::Zero();
  /// Mean information of a motion about the parameters that the motions of both have in common, in
  /// units in which noise alone would give either the identity; see least_shown. Zero for
  /// parameters that are not fitted.
  OffsetMatrix information = OffsetMatrix::Zero();
  /// Orthonormal columns: the directions that the motions leave free, in the same units.
  Eigen::Matrix<double, kOffsetParameters, Eigen::Dynamic> free;
  int motions = 0;
  double duration = 0;       ///< of a motion [s], or in frames
  double translation_m = 0;  ///< scatter of the motions' errors along an axis
  double rotation_rad = 0;   ///< and about an axis
};

/// Information that the motions of both must have in common about a direction that counts as
/// shown, where noise alone would give either 1. Chosen. A truth without orientations is compared
/// with motions of the estimate alone, whose noise is part of the information: more is asked for.
inline double least_shown(bool positions_alone) { return positions_alone ? 3 : 1; }

/// Fits the parameters to the motions of both trajectories.
///
/// The equations `sum instrument^T W error = 0` are solved by Newton's method (instrumental
/// variables, so that noise of the estimate's motions does not pull a lever arm towards zero).
/// W is the inverse of the errors' own scatter (median), with Huber's weights. The duration of the
/// motions is that which gives most information for its length. The covariance is that of the
/// slowest waves of the scores along the drive, so that errors may be correlated for as long as a
/// fraction of these, and is enlarged as Student's distribution asks.
OffsetFit fit_offsets(const OffsetEquations& equations, const OffsetMask& mask,
                      const OffsetState& start);

}  // namespace placegraph
