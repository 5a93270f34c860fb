#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/pose_graph/constraint.h>

namespace [[gnu::visibility("default")]] placegraph {

enum class PoseGraphEngine { kNative, kCeres };

/// How the native engine steps; Ceres always takes Levenberg-Marquardt.
enum class StepRule { kDogleg, kGaussNewton, kLevenbergMarquardt };

/// Where the descent begins.
enum class PoseGraphStart {
  kAuto,       ///< the cheapest start whose minimum can be trusted
  kFile,       ///< the poses as they are
  kOdometry,   ///< spanning_tree_start
  kChordal,    ///< chordal_start
  kCertified,  ///< certified_start
};

enum class GncSurrogate { kTruncated, kGemanMcClure };

struct GncOptions {
  GncSurrogate surrogate = GncSurrogate::kTruncated;
  double least_factor = 1.4;     ///< by which a round lowers the threshold at least
  double share_per_round = 0.1;  ///< of the undecided edges that a round may leave behind
  int max_rounds = 60;
  void check() const;
};
void visit(OptionVisitor& field, GncOptions& options);

struct LoopSupportOptions {
  int reach = 100;      ///< poses between the ends of two loops that are held against each other
  int neighbours = 10;  ///< loops that one loop is held against, the nearest ones
  double least_probability = 0.9;  ///< that two loops are both true, for them to support each other
  void check() const;
};
void visit(OptionVisitor& field, LoopSupportOptions& options);

struct LoopGrowthOptions {
  /// The gate of a loop's squared error is this many times the chi-squared quantile of Gaussian
  /// noise: measured loops have longer tails.
  double margin = 1.5;
  /// A loop with an error beyond the gate is still one of the others if it is at most this many
  /// times the largest error among them.
  double tail = 3;
  /// A loop that says nearly the right thing, off by at most this share of the map's extent and of
  /// half a turn, is badly measured rather than false: its gate is twenty times as wide.
  double nearly_right = 0.01;
  int max_rounds = 20;
  void check() const;
};
void visit(OptionVisitor& field, LoopGrowthOptions& options);

enum class RobustMethod { kNone, kHuber, kDcs, kGnc, kPcm, kAuto };

struct RobustOptions {
  RobustMethod method = RobustMethod::kNone;
  double kernel_width = 1;  ///< of huber and dcs, in standard deviations
  /// Share of the true loops whose squared error lies below the gate, were their noise Gaussian.
  double gate_probability = 0.999;
  GncOptions gnc = {};
  LoopSupportOptions support;
  LoopGrowthOptions growth;
  void check() const;
};
void visit(OptionVisitor& field, RobustOptions& options);

struct PoseGraphOptions {
  RotationError rotation_error = RotationError::kLog;
  PoseGraphEngine engine = PoseGraphEngine::kNative;
  StepRule step_rule = StepRule::kDogleg;
  /// kAuto: with `robust` the poses as they are (with gnc those of the odometry), because false
  /// loops spoil the other starts.
  PoseGraphStart start = PoseGraphStart::kAuto;
  int max_iterations = 200;
  double relative_decrease = 1e-9;  ///< stop when the cost falls by less than this share
  RobustOptions robust = {};        ///< what is done against false loops
  void check() const;
};
void visit(OptionVisitor& field, PoseGraphOptions& options);

}  // namespace placegraph
