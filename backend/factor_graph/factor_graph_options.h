#pragma once
#include <placegraph/backend/pose_graph/pose_graph_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/robust_kernel.h>
#include <placegraph/graph/pose_graph/constraint.h>

namespace [[gnu::visibility("default")]] placegraph {

struct FactorGraphOptions {
  int max_iterations = 100;
  double relative_decrease = 1e-9;  ///< stop when the cost falls by less than this share
  void check() const;
};
void visit(OptionVisitor& field, FactorGraphOptions& options);

struct BundleOptions {
  int max_iterations = 200;
  double relative_decrease = 1e-7;  ///< stop when the cost falls by less than this share
  RobustKernel kernel;              ///< width in pixels
  void check() const;
};
void visit(OptionVisitor& field, BundleOptions& options);

struct LandmarkGraphOptions {
  RotationError rotation_error = RotationError::kLog;
  PoseGraphEngine engine = PoseGraphEngine::kNative;  ///< kCeres: as a factor graph
  int max_iterations = 200;
  double relative_decrease = 1e-9;  ///< stop when the cost falls by less than this share
};

}  // namespace placegraph
