#pragma once
#include <placegraph/backend/factor_graph/factor_graph_options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/pose_graph/bundle.h>

namespace [[gnu::visibility("default")]] placegraph {

/// The result of a bundle adjustment.
struct BundleReport {
  Outcome outcome;                          ///< see adjust_bundle
  Bundle bundle;                            ///< with the estimate; the input if there is none
  double cost_initial = 0, cost_final = 0;  ///< half the sum of rho(squared error [px^2])
  double rms_px = 0;   ///< root of the mean squared reprojection error at the end, without kernel
  int iterations = 0;  ///< steps of Levenberg-Marquardt
};

/// Full bundle adjustment of poses, focal lengths, distortions and points.
/// It minimizes the reprojection errors, each with a standard deviation of 1 px. They do not
/// determine position, orientation and scale of the whole, which stay near the start. Throws
/// ArgumentError as Bundle::check and for options out of range. kTooFewData: no observations;
/// kNotConverged: the report has the estimate so far.
[[nodiscard]] BundleReport adjust_bundle(const Bundle& bundle, const BundleOptions& options);

}  // namespace placegraph
