#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/pose_graph/constraint.h>

namespace [[gnu::visibility("default")]] placegraph {

/// The solver that finds the minimum: the library's own or Ceres.
enum class PoseGraphEngine { kNative, kCeres };

/// How the native engine steps; Ceres always takes Levenberg-Marquardt.
enum class StepRule { kDogleg, kGaussNewton, kLevenbergMarquardt };

/// The poses from which the descent begins.
enum class PoseGraphInitialization {
  kAuto,       ///< the cheapest start whose minimum can be trusted
  kFile,       ///< the poses as they are
  kOdometry,   ///< measurements chained along a spanning tree, odometry first
  kChordal,    ///< chordal relaxation: rotations by linear least squares, then translations
  kCertified,  ///< semidefinite relaxation: the global minimum where the relaxation is tight
};

/// Name of a start as in the options: "auto", "file", "odometry", "chordal" or "certified".
const char* to_string(PoseGraphInitialization start);

/// The robust cost that graduated non-convexity approaches.
enum class GncSurrogate { kTruncated, kGemanMcClure };

/// The schedule of graduated non-convexity (Yang et al. 2020).
/// Each round lowers the threshold of squared errors by `least_factor`, or further as long as it
/// rejects no more than `share_per_round` of the edges that are neither accepted nor rejected.
struct GncOptions {
  GncSurrogate surrogate = GncSurrogate::kTruncated;  ///< the robust cost that is approached
  double least_factor = 1.4;     ///< by which a round lowers the threshold at least, see above
  double share_per_round = 0.1;  ///< of the undecided edges that a round may reject, see above
  int max_rounds = 60;           ///< of reweighting, at most
  void check() const;
};
void visit(OptionVisitor& field, GncOptions& options);

/// Which loops are compared with which: true loops agree with true ones nearby.
struct LoopSupportOptions {
  int reach = 100;      ///< poses that may lie between the ends of two loops that are compared
  int neighbours = 10;  ///< loops that one loop is compared with, the nearest ones
  double least_probability = 0.9;  ///< that two loops are both true, for them to support each other
  void check() const;
};
void visit(OptionVisitor& field, LoopSupportOptions& options);

/// How loops are accepted and tested, from the best supported ones on (kAuto, kGnc and kPcm).
struct LoopSetGrowthOptions {
  /// The gate of a loop's squared error is this many times the chi-squared quantile of Gaussian
  /// noise: measured loops have longer tails.
  double margin = 1.5;
  /// A loop with an error beyond the gate is still accepted if the error is at most this many times
  /// the largest error among the accepted ones.
  double tail = 3;
  /// A loop whose error is at most this share of the map's extent and of half a turn is badly
  /// measured rather than false: its gate is twenty times as wide.
  double nearly_right = 0.01;
  int max_rounds = 20;  ///< of testing every loop, at most
  void check() const;
};
void visit(OptionVisitor& field, LoopSetGrowthOptions& options);

/// What is done against false loops. Odometry and measured positions are always trusted.
enum class RobustMethod {
  kNone,   ///< nothing: all constraints with the kernels that they carry
  kHuber,  ///< Huber's kernel on every loop; none is rejected
  kDcs,    ///< dynamic covariance scaling of every loop (Agarwal et al. 2013); none is rejected
  kGnc,    ///< graduated non-convexity (Yang et al. 2020), then a test of every loop
  kPcm,    ///< pairwise consistency maximization (Mangelsdorf et al. 2018), then such a test
  kAuto    ///< none if no loop looks false, else loops by the support of others: the best choice
};

/// What is done against false loops, and how strictly loops are judged.
struct RobustOptions {
  RobustMethod method = RobustMethod::kNone;  ///< the default rejects nothing
  double kernel_width = 1;                    ///< of kHuber and kDcs, in standard deviations
  /// Share of the true loops whose squared error is below the gate, were their noise Gaussian.
  double gate_probability = 0.999;
  GncOptions gnc = {};          ///< of kGnc, kPcm and kAuto
  LoopSupportOptions support;   ///< of kGnc, kPcm and kAuto
  LoopSetGrowthOptions growth;  ///< of kGnc, kPcm and kAuto
  void check() const;
};
void visit(OptionVisitor& field, RobustOptions& options);

/// What optimize_pose_graph minimizes, from which start and by which solver.
struct PoseGraphOptions {
  RotationError rotation_error = RotationError::kLog;  ///< how the error of a rotation is written
  PoseGraphEngine engine = PoseGraphEngine::kNative;   ///< which solver finds the minimum
  StepRule step_rule = StepRule::kDogleg;              ///< of the native engine
  /// With a robust method kAuto means the poses as they are (with kGnc those of the odometry),
  /// because false loops spoil the other starts.
  PoseGraphInitialization start = PoseGraphInitialization::kAuto;
  int max_iterations = 200;         ///< steps of one descent at most; kAuto may make several
  double relative_decrease = 1e-9;  ///< stop when the cost falls by less than this share
  RobustOptions robust = {};        ///< what is done against false loops
  void check() const;
};
void visit(OptionVisitor& field, PoseGraphOptions& options);

}  // namespace placegraph
