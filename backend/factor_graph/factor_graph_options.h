#pragma once
#include <placegraph/backend/pose_graph/pose_graph_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/robust_kernel.h>
#include <placegraph/graph/pose_graph/constraint.h>

namespace [[gnu::visibility("default")]] placegraph {

/// When optimize_factor_graph stops.
struct FactorGraphOptions {
  int max_iterations = 100;         ///< steps of Levenberg-Marquardt at most
  double relative_decrease = 1e-9;  ///< stop when the cost falls by less than this share
  void check() const;
};
void visit(OptionVisitor& field, FactorGraphOptions& options);

/// When adjust_bundle stops, and its robust kernel.
struct BundleOptions {
  int max_iterations = 200;         ///< steps of Levenberg-Marquardt at most
  double relative_decrease = 1e-7;  ///< stop when the cost falls by less than this share
  RobustKernel kernel;              ///< of the reprojection errors, width in pixels
  void check() const;
};
void visit(OptionVisitor& field, BundleOptions& options);

/// What optimize_landmark_graph minimizes, and when it stops.
struct LandmarkGraphOptions {
  RotationError rotation_error = RotationError::kLog;  ///< of relative poses and of priors
  PoseGraphEngine engine = PoseGraphEngine::kNative;   ///< kCeres: as a factor graph
  int max_iterations = 200;                            ///< steps at most
  double relative_decrease = 1e-9;  ///< stop when the cost falls by less than this share
};

}  // namespace placegraph
