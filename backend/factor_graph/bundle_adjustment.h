#pragma once
#include <placegraph/backend/factor_graph/factor_graph_options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/pose_graph/bundle.h>

namespace [[gnu::visibility("default")]] placegraph {

struct BundleReport {
  Outcome outcome;
  Bundle bundle;                            ///< with the estimate; as it came if there is none
  double cost_initial = 0, cost_final = 0;  ///< half the sum of rho(squared error [px^2])
  double rms_px = 0;                        ///< of the reprojection errors at the end, no kernel
  int iterations = 0;
};

/// Full bundle adjustment: the poses, focal lengths and distortions of all cameras and all points
/// that least squares of the reprojection errors give (RadialReprojectionFactor in a FactorGraph).
/// Seven directions stay open (position, heading, scale of the whole): there nothing moves. Throws
/// as Bundle::check. kTooFewData: no observations; kNotConverged: the estimate so far is there.
[[nodiscard]] BundleReport adjust_bundle(const Bundle& bundle, const BundleOptions& options);

}  // namespace placegraph
