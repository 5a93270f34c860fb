#pragma once
#include <placegraph/graph/core/options.h>

namespace [[gnu::visibility("default")]] placegraph {

/// The robust cost that graduated non-convexity approaches.
enum class GncSurrogate { kTruncated, kGemanMcClure };

/// The schedule of graduated non-convexity (Yang et al. 2020).
/// Each round divides the threshold of squared errors by `least_factor`, or by more as long as it
/// rejects at most `share_per_round` of the edges that are neither accepted nor rejected yet.
struct GncOptions {
  GncSurrogate surrogate = GncSurrogate::kTruncated;  ///< approximated robust cost
  double least_factor = 1.4;     ///< minimum factor of the threshold per round, see above
  double share_per_round = 0.1;  ///< share of the undecided edges that a round may reject
  int max_rounds = 60;           ///< maximum number of rounds of reweighting
  void check() const;
};
void visit(OptionVisitor& field, GncOptions& options);

/// Selection of the loops that are compared: true loops agree with true loops nearby.
struct LoopSupportOptions {
  int reach = 100;      ///< maximum number of poses between the ends of two compared loops
  int neighbours = 10;  ///< number of nearest loops that each loop is compared with
  double least_probability = 0.9;  ///< minimum probability that supporting loops are both true
  void check() const;
};
void visit(OptionVisitor& field, LoopSupportOptions& options);

/// Acceptance and tests of loops by loop set growth (kAuto, kGnc and kPcm).
/// It starts with the loops that have most support.
struct LoopSetGrowthOptions {
  /// The gate of a loop's squared error is this factor times the chi-squared quantile of Gaussian
  /// noise, because measured loops have longer tails.
  double margin = 1.5;
  /// A loop whose error exceeds the gate is still accepted if the error is at most this factor
  /// times the largest error among the accepted loops.
  double tail = 3;
  /// A loop whose error is at most this share of the map's extent and of a rotation by 180 deg is
  /// considered inaccurate, not false: its gate is twenty times as wide.
  double nearly_right = 0.01;
  int max_rounds = 20;  ///< maximum number of rounds in which every loop is tested
  void check() const;
};
void visit(OptionVisitor& field, LoopSetGrowthOptions& options);

/// Robust methods against false loops; odometry and measured positions are always accepted.
enum class RobustMethod {
  kNone,   ///< none: all constraints with their own kernels
  kHuber,  ///< Huber's kernel on every loop; none is rejected
  kDcs,    ///< dynamic covariance scaling of every loop (Agarwal et al. 2013); none is rejected
  kGnc,    ///< graduated non-convexity (Yang et al. 2020), then a test of every loop
  kPcm,    ///< pairwise consistency maximization (Mangelsdorf et al. 2018), then the same test
  kAuto    ///< none if no loop appears false, else loop set growth; the recommended method
};

/// Options of the robust optimization against false loops.
struct RobustOptions {
  RobustMethod method = RobustMethod::kNone;  ///< method; the default rejects no loop
  double kernel_width = 1;                    ///< for kHuber and kDcs, in standard deviations
  /// Share of the true loops whose squared error would be below the gate if their noise were
  /// Gaussian.
  double gate_probability = 0.999;
  GncOptions gnc = {};          ///< schedule, for kGnc, kPcm and kAuto
  LoopSupportOptions support;   ///< compared loops, for kGnc, kPcm and kAuto
  LoopSetGrowthOptions growth;  ///< acceptance of loops, for kGnc, kPcm and kAuto
  void check() const;
};
void visit(OptionVisitor& field, RobustOptions& options);

}  // namespace placegraph
