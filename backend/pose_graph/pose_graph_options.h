#pragma once
#include <placegraph/backend/robust/robust_options.h>
#include <placegraph/backend/solver/solver_engine.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/pose_graph/constraint.h>

namespace [[gnu::visibility("default")]] placegraph {

/// The initial poses of the optimization.
enum class PoseGraphInitialization {
  kAuto,       ///< the cheapest initialization whose minimum can be trusted
  kFile,       ///< the poses of the input
  kOdometry,   ///< measurements chained along a spanning tree, odometry first
  kChordal,    ///< chordal relaxation: rotations by linear least squares, then translations
  kCertified,  ///< semidefinite relaxation: the global minimum where the relaxation is tight
};

/// Name of an initialization as in the options.
/// "auto", "file", "odometry", "chordal" or "certified".
const char* to_string(PoseGraphInitialization initialization);

/// Options of optimize_pose_graph: cost, initialization, solver and robust method.
struct PoseGraphOptions {
  RotationError rotation_error = RotationError::kLog;  ///< parametrization of a rotation's error
  PoseGraphEngine engine = PoseGraphEngine::kNative;   ///< solver
  StepRule step_rule = StepRule::kDogleg;              ///< step rule of the native engine
  /// Initialization. With a robust method kAuto selects the poses of the input (with kGnc those of
  /// the odometry), because false loops corrupt the other initializations.
  PoseGraphInitialization initialization = PoseGraphInitialization::kAuto;
  int max_iterations = 200;         ///< maximum steps of one descent; kAuto may run several
  double relative_decrease = 1e-9;  ///< stop when the cost falls by less than this share
  RobustOptions robust = {};        ///< robust method against false loops
  void check() const;
};
void visit(OptionVisitor& field, PoseGraphOptions& options);

}  // namespace placegraph
