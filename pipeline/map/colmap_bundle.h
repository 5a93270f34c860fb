#pragma once
#include <placegraph/backend/factor_graph/factor_graph_options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/io/exports/colmap_model.h>

#include <cstddef>

namespace placegraph {

/// The result of adjusting a COLMAP model.
struct ColmapBundleReport {
  Outcome outcome;                           ///< outcome, see adjust_colmap
  ColmapModel model;                         ///< with the estimate; the input if there is none
  std::size_t observations = 0;              ///< number of observations
  double cost_initial = 0, cost_final = 0;   ///< half the sum of rho(squared error [px^2])
  double error_before_px = 0, error_px = 0;  ///< mean reprojection errors, without the kernel
  int iterations = 0;                        ///< number of steps of Levenberg-Marquardt
};

/// Bundle adjustment of the poses and points of a COLMAP model; its camera is held.
/// It minimizes the reprojection errors, each with a standard deviation of 1 px. They do not
/// determine position, orientation and scale of the model, which stay near the initial ones. The
/// errors of the points are computed again. Throws ArgumentError for options out of range.
/// kTooFewData: no observations; kNotConverged: the report has the last estimate.
[[nodiscard]] ColmapBundleReport adjust_colmap(const ColmapModel& model,
                                               const BundleOptions& options);

}  // namespace placegraph
