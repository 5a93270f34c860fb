#pragma once
#include <placegraph/backend/pose_graph/pose_graph_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/robust_kernel.h>
#include <placegraph/graph/pose_graph/constraint.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Stopping criteria of optimize_factor_graph.
struct FactorGraphOptions {
  int max_iterations = 100;         ///< steps of Levenberg-Marquardt at most
  double relative_decrease = 1e-9;  ///< stop when the cost falls by less than this share
  void check() const;
};
void visit(OptionVisitor& field, FactorGraphOptions& options);

/// Stopping criteria of adjust_bundle, and its robust kernel.
struct BundleOptions {
  int max_iterations = 200;         ///< steps of Levenberg-Marquardt at most
  double relative_decrease = 1e-7;  ///< stop when the cost falls by less than this share
  RobustKernel kernel;              ///< kernel of the reprojection errors, width [px]
  void check() const;
};
void visit(OptionVisitor& field, BundleOptions& options);

/// Rotation error, solver and stopping criteria of optimize_landmark_graph.
struct LandmarkGraphOptions {
  RotationError rotation_error = RotationError::kLog;  ///< error of relative poses and of priors
  PoseGraphEngine engine = PoseGraphEngine::kNative;   ///< solver; kCeres: as a factor graph
  int max_iterations = 200;                            ///< maximum number of steps
  double relative_decrease = 1e-9;  ///< stop when the cost falls by less than this share
};

}  // namespace placegraph
