#pragma once
#include <placegraph/frontend/internal/vanishing/vanishing_evidence.h>

#include <Eigen/Dense>
#include <optional>
#include <utility>
#include <vector>

namespace placegraph {

using TangentBasis = Eigen::Matrix<double, 3, 2>;
/// Two unit vectors at right angles to `v` and to each other, in columns.
TangentBasis tangent_basis(const Eigen::Vector3d& v);
/// Description length of `n` lines of `total` that have one direction, for its share of them
/// [nats].
double entropy_term(double n, double total);

/// A direction of largest likelihood for some lines.
struct FittedDirection {
  bool ok = false;                                       ///< false: the lines do not fix it
  bool held = false;                                     ///< it is not fitted anew with others
  Eigen::Vector3d v = Eigen::Vector3d::UnitZ();          ///< camera frame, z >= 0
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of v; zero along v
  /// What stating it so finely costs [nats]: -log of the square root of the determinant of the
  /// covariance across v by its lines, less what a DirectionPrior says of it.
  double precision_cost = 0;
  int across_axis = -1;  ///< of a DirectionPrior, that it lies at right angles to; -1: of none
};

/// What the axes of rectangular worlds say of further directions of the same scene: edges mostly
/// lie at right angles to one of them, as level ones do to the upright, and slopes of a roof to the
/// ridge.
struct DirectionPrior {
  std::vector<Eigen::Vector3d> axes;  ///< unit, camera frame; none: anywhere is as likely
  double sigma_rad = 0.035;           ///< from right angles
  double free_share = 0.25;           ///< of the directions that lie anywhere

  /// Pulls a fit towards right angles to the axis that it most probably lies across, if it does
  /// (FittedDirection::across_axis), and takes what the prior says of it off its precision_cost;
  /// what its lines lose by the move, they tell themselves.
  void pull(FittedDirection& fit) const;
};

/// Refines a direction over lines of the evidence by reweighted Gauss-Newton in the two directions
/// across it.
FittedDirection fit_direction(const VanishingEvidence& evidence, const Eigen::Vector3d& start,
                              const std::vector<int>& lines, int iterations);

/// Which line points where: directions that compete for the lines of an image, all in one cost, a
/// description length in nats; that of no direction is zero.
///  - a line: -log of the density of its error over that of a line that points anywhere, and of the
///    share of the lines that its direction (or none) has;
///  - a direction: the precision at which it is known, and `cost_per_direction`.
class VanishingModel {
 public:
  /// The evidence must outlive the model.
  VanishingModel(const VanishingEvidence& evidence, double cost_per_direction, int min_lines)
      : evidence_(&evidence), cost_per_direction_(cost_per_direction), min_lines_(min_lines) {}

  /// Of the directions that are not held, from now on.
  void expect(DirectionPrior prior) { prior_ = std::move(prior); }

  int size() const { return static_cast<int>(directions_.size()); }
  const std::vector<FittedDirection>& directions() const { return directions_; }
  /// Per line, an index into directions() or -1.
  const std::vector<int>& of() const { return of_; }
  double cost() const { return cost_; }
  std::vector<int> lines_of(int direction) const;

  /// The model with one more direction, fitted to the lines it wins; nothing if it wins too few.
  std::optional<VanishingModel> with(const Eigen::Vector3d& v) const;
  /// Without one; its lines go where they fit next, then the others are fitted anew so often.
  VanishingModel without(int direction, int polish_rounds) const;
  /// The model with these directions as they are; the lines are assigned anew.
  VanishingModel with_all(const std::vector<FittedDirection>& directions) const;
  /// Fits all directions and assigns all lines anew, `rounds` times; with noise that has changed,
  /// too. Directions that lose their lines go.
  /// Held ones stay as they are.
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
  std::vector<std::vector<double>> ratios_;  ///< log_ratio of each line, a row a direction
  std::vector<int> of_;
  double cost_ = 0;
};

}  // namespace placegraph
