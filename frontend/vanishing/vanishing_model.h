#pragma once
#include <placegraph/frontend/vanishing/vanishing_evidence.h>

#include <Eigen/Dense>
#include <optional>
#include <utility>
#include <vector>

namespace placegraph {

/// Description length of a vanishing point beside its precision. Chosen.
constexpr double kPointCost_nats = 8;

using TangentBasis = Eigen::Matrix<double, 3, 2>;
/// Two unit vectors orthogonal to `v` and to each other, in columns.
TangentBasis tangent_basis(const Eigen::Vector3d& v);
/// Description length for the share of `n` lines of `total` that have one direction [nats].
double entropy_term(double n, double total);

/// Direction of largest likelihood for some lines.
struct FittedDirection {
  bool ok = false;                               ///< false: the lines do not determine it
  bool held = false;                             ///< fixed: it is not fitted again with others
  Eigen::Vector3d v = Eigen::Vector3d::UnitZ();  ///< direction in the camera frame, z >= 0
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< covariance of v; zero along v
  /// Cost of the precision of v [nats]: -log of the square root of the determinant of the
  /// covariance across v by its lines, minus the contribution of a DirectionPrior.
  double precision_cost = 0;
  int across_axis = -1;  ///< axis of a DirectionPrior to which it is orthogonal; -1: none
};

/// Prior of further directions from the axes of the Manhattan frames of the same scene.
///
/// Edges are mostly orthogonal to one of the axes, like level ones to the upright axis, and slopes
/// of a roof to the ridge.
struct DirectionPrior {
  /// Unit, camera frame; empty: all directions are equally probable.
  std::vector<Eigen::Vector3d> axes;
  double sigma_rad = 0.035;  ///< standard deviation from right angles
  double free_share = 0.25;  ///< share of the directions without a preferred angle

  /// Pulls a fit towards right angles to its most probable orthogonal axis, if there is one
  /// (FittedDirection::across_axis), and subtracts the prior's contribution from its
  /// precision_cost; the loss of its lines by the move is part of their own cost.
  void pull(FittedDirection& fit) const;
};

/// Refines a direction over lines of the evidence by reweighted Gauss-Newton in the two directions
/// across it.
FittedDirection fit_direction(const VanishingEvidence& evidence, const Eigen::Vector3d& start,
                              const std::vector<int>& lines, int iterations);

/// Assignment of lines to directions that compete for them.
///
/// The single cost is a description length in nats; without any direction it is zero.
/// - a line: -log of the ratio of the density of its error to that of a line of any direction, and
///   of the share of the lines that its direction (or none) has;
/// - a direction: its precision, and `cost_per_direction`.
class VanishingModel {
 public:
  /// Starts without directions. The evidence must outlive the model.
  VanishingModel(const VanishingEvidence& evidence, double cost_per_direction, int min_lines)
      : evidence_(&evidence), cost_per_direction_(cost_per_direction), min_lines_(min_lines) {}

  /// Sets the prior of the directions that are not fixed, from now on.
  void expect(DirectionPrior prior) { prior_ = std::move(prior); }

  int size() const { return static_cast<int>(directions_.size()); }
  const std::vector<FittedDirection>& directions() const { return directions_; }
  /// Direction of each line, an index into directions() or -1.
  const std::vector<int>& of() const { return of_; }
  double cost() const { return cost_; }
  std::vector<int> lines_of(int direction) const;

  /// Copy of the model with one more direction, fitted to the lines it wins; nothing if it wins too
  /// few.
  std::optional<VanishingModel> with(const Eigen::Vector3d& v) const;
  /// Copy without one direction; its lines are assigned to others, which are then fitted again
  /// `polish_rounds` times.
  VanishingModel without(int direction, int polish_rounds) const;
  /// Copy with these directions, unchanged; the lines are assigned again.
  VanishingModel with_all(const std::vector<FittedDirection>& directions) const;
  /// Fits all directions and assigns all lines again, `rounds` times, e.g. after a change of the
  /// noise. Directions without enough lines are removed; fixed ones are not changed.
  void polish(int rounds);

 private:
  void append(const FittedDirection& direction);
  void remove(int direction);
  void assign(int rounds);
  FittedDirection fit(const Eigen::Vector3d& start, const std::vector<int>& lines) const;
  std::vector<double> ratios(const Eigen::Vector3d& v) const;

  const VanishingEvidence* evidence_;
  double cost_per_direction_ = 0;
  DirectionPrior prior_;
  int min_lines_ = 3;
  std::vector<FittedDirection> directions_;
  std::vector<std::vector<double>> ratios_;  ///< log_ratio of each line, one row per direction
  std::vector<int> of_;
  double cost_ = 0;
};

}  // namespace placegraph
