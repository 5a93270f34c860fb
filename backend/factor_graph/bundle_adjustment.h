#pragma once
#include <placegraph/backend/factor_graph/factor_graph_options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/pose_graph/bundle.h>

namespace [[gnu::visibility("default")]] placegraph {

/// The result of a bundle adjustment.
struct BundleReport {
  Outcome outcome;  ///< outcome, see adjust_bundle
  Bundle bundle;    ///< bundle with the estimate; the input if there is none
  double cost_initial = 0, cost_final = 0;  ///< half the sum of rho(squared error [px^2])
  double rms_px = 0;   ///< root of the mean squared reprojection error at the end, without kernel
  int iterations = 0;  ///< number of steps of Levenberg-Marquardt
};

/// Full bundle adjustment of poses, focal lengths, distortions and points.
/// It minimizes the reprojection errors, each with a standard deviation of 1 px. They do not
/// determine the position, orientation and scale of the whole bundle, which stay near the initial
/// values. Throws ArgumentError as Bundle::check and for options out of range. kTooFewData: no
/// observations; kNotConverged: the report has the last estimate.
[[nodiscard]] BundleReport adjust_bundle(const Bundle& bundle, const BundleOptions& options);

}  // namespace placegraph
