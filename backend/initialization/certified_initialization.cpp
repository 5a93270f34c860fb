#include <placegraph/backend/initialization/certified_initialization.h>
#include <placegraph/backend/initialization/chordal_relaxation.h>
#include <placegraph/backend/initialization/held_nodes.h>
#include <placegraph/backend/initialization/initialization.h>
#include <placegraph/backend/initialization/rotation_agreement.h>

#include <algorithm>

namespace placegraph {
namespace {

// Ranks above d that the staircase tries: the cost. Chosen.
constexpr int kMostLifts = 6;
/// Maximum steps of all lifted descents times poses: without a tight relaxation many steps gain
/// nothing.
constexpr double kLiftedEffort = 2e5;
constexpr double kFewestLiftedSteps = 20, kMostLiftedSteps = 300;
/// The staircase ends when a lifted descent lowers the cost by less than this share.
constexpr double kLiftedGain = 1e-7;
constexpr double kLiftedPromiseShare = 1e-12;
/// If a minimum of higher rank is below the one that it rounds to by this share, the relaxation is
/// not tight: a bound can still be computed, but no lower minimum of rank d.
constexpr double kGapOfNoReturn = 1e-2;
/// Share of the effort that one descent may take.
constexpr double kDescentShare = 0.4;
/// Number of systems that a restart of the Lanczos search for an eigenvalue solves.
constexpr int kSolutionsOfRestart = 12;
// Bounds of the restarts that the effort affords. Chosen.
constexpr double kFewestRestarts = 5, kMostRestarts = 300;
// Relative gap of a minimum that counts as global. Chosen.
constexpr double kTightGap = 1e-5;
/// A shift of the certificate matrix that lowers the bound by this share is accepted without a
/// search.
constexpr double kAcceptedShare = 1e-7;
constexpr int kShortDescent = 15;  ///< steps to a nearby minimum

/// Writes the rotations and translations of the point of rank d to the poses.
/// Every component is moved as a whole to the pose of its first anchor; anchors keep their poses.
template <class Group>
void set_poses(const Eigen::MatrixXd& X, PackedGraph<Group>& graph) {
  constexpr int dim = kSpaceDim<Group>;
  using Rotation = std::decay_t<decltype(graph.poses[0].rotation())>;
  const auto rotation = [&](std::size_t i) {
    return nearest_rotation(
        Eigen::Matrix<double, dim, dim>(X.middleCols<dim>(static_cast<int>(i) * (dim + 1))));
  };
  const auto translation = [&](std::size_t i) ->
      typename Group::Point { return X.col(static_cast<int>(i) * (dim + 1) + dim); };
  struct Motion {
    bool known = false;
    Rotation R;
    typename Group::Point t;
  };
  const GraphComponents& components = graph.components;
  std::vector<Motion> motions(components.first.size());
  for (std::size_t i = 0; i < graph.poses.size(); ++i) {
    Motion& motion = motions[components.component[i]];
    if (!components.anchor[i] || motion.known) continue;
    motion.known = true;
    motion.R = graph.poses[i].rotation() * rotation(i).inverse();
    motion.t = graph.poses[i].translation() - motion.R * translation(i);
  }
  for (std::size_t i = 0; i < graph.poses.size(); ++i) {
    if (components.anchor[i]) continue;
    const Motion& motion = motions[components.component[i]];
    const Rotation R = motion.R * rotation(i);
    const typename Group::Point t = motion.R * translation(i) + motion.t;
    if constexpr (Group::kDof == 7)
      graph.poses[i] = Sim3(R, t, graph.poses[i].scale());
    else
      graph.poses[i] = Group(R, t);
  }
}

/// Descents and searches of one certified initialization, with their common maximum effort.
template <int dim>
class Climber {
 public:
  Climber(const ChordalRelaxation<dim>& relaxation, double max_effort)
      : relaxation_(relaxation), max_effort_(max_effort) {}

  double effort() const { return effort_; }
  bool exhausted() const { return effort_ >= max_effort_; }
  /// A descent with at most this share of the maximum effort.
  typename ChordalRelaxation<dim>::Descent minimize(
      Eigen::MatrixXd& X, double share, typename ChordalRelaxation<dim>::DescentOptions options) {
    options.max_effort = share * max_effort_;
    const auto descent = relaxation_.minimize(X, options);
    effort_ += descent.effort;
    return descent;
  }
  typename CertificateMatrix<dim>::Curvature curvature(CertificateMatrix<dim>& matrix,
                                                       double accepted_shift) {
    const double restart = relaxation_.certificate_effort(0, kSolutionsOfRestart);
    const double affordable = std::max(0.0, max_effort_ - effort_) / restart;
    const auto curvature = matrix.curvature(
        accepted_shift, static_cast<int>(std::clamp(affordable, kFewestRestarts, kMostRestarts)));
    effort_ += relaxation_.certificate_effort(curvature.factorizations, curvature.solutions);
    return curvature;
  }

 private:
  const ChordalRelaxation<dim>& relaxation_;
  double max_effort_, effort_ = 0;
};

/// The minimum of rank d that the lifted point rounds to, if it is lower than X.
template <int dim>
void take_rounded(const ChordalRelaxation<dim>& relaxation, const Eigen::MatrixXd& lifted,
                  Climber<dim>& climber, Eigen::MatrixXd& X, double& cost) {
  Eigen::MatrixXd rounded = relaxation.round(lifted);
  const double rounded_cost = climber.minimize(rounded, kDescentShare, {}).cost;
  if (rounded_cost >= cost) return;
  cost = rounded_cost;
  X = std::move(rounded);
}

/// The staircase from X, a minimum of rank d; X becomes the lowest minimum of rank d.
template <int dim>
CertifiedInitializationReport climb(const ChordalRelaxation<dim>& relaxation, int nodes,
                                    double max_effort, Eigen::MatrixXd& X) {
  Climber<dim> climber(relaxation, max_effort);
  CertifiedInitializationReport report;
  report.rank = dim;
  report.cost = climber.minimize(X, kDescentShare, {}).cost;
  double lifted_cost = report.cost;
  bool promising = true;
  Eigen::MatrixXd lifted = X;
  int steps =
      static_cast<int>(std::clamp(kLiftedEffort / nodes, kFewestLiftedSteps, kMostLiftedSteps));
  for (int lifts = 0;; ++lifts) {
    CertificateMatrix<dim> matrix = relaxation.certificate_matrix(lifted);
    const double accepted =
        kAcceptedShare * lifted_cost / (static_cast<double>(nodes) * dim) + 1e-13 * matrix.scale();
    const auto curvature = climber.curvature(matrix, accepted);
    report.lower_bound = std::max(report.lower_bound, matrix.lower_bound(curvature.shift));
    report.relative_gap = matrix.relative_gap(report.cost, report.lower_bound);
    if (report.relative_gap <= kTightGap || curvature.direction.size() == 0 ||
        curvature.smallest_eigenvalue >= -10 * accepted || lifts == kMostLifts || steps <= 0 ||
        !promising || climber.exhausted())
      break;
    lifted = relaxation.escape(lifted, curvature.direction);
    const auto descent = climber.minimize(
        lifted, kDescentShare, {.max_steps = steps, .promise_share = kLiftedPromiseShare});
    const bool gained = descent.cost < (1 - kLiftedGain) * lifted_cost;
    lifted_cost = descent.cost;
    steps -= descent.iterations + 1;
    report.rank = static_cast<int>(lifted.rows());
    take_rounded(relaxation, lifted, climber, X, report.cost);
    const bool far_from_tight =
        descent.converged && report.cost > (1 + kGapOfNoReturn) * lifted_cost;
    promising = gained && !far_from_tight;
  }
  report.effort = climber.effort();
  report.tight = report.relative_gap <= kTightGap;
  return report;
}

/// Whether X is a global minimum to kTightGap, by one factorization.
template <int dim>
bool proves_itself(const ChordalRelaxation<dim>& relaxation, int nodes, const Eigen::MatrixXd& X) {
  const double cost = relaxation.cost(X);
  CertificateMatrix<dim> matrix = relaxation.certificate_matrix(X);
  const double shift =
      0.5 * kTightGap * cost / (static_cast<double>(nodes) * dim) + 1e-13 * matrix.scale();
  // The cost is nonnegative, so zero is always a lower bound.
  return matrix.relative_gap(cost, 0) <= kTightGap ||
         (matrix.positive_with(shift) &&
          matrix.relative_gap(cost, matrix.lower_bound(shift)) <= kTightGap);
}

}  // namespace

template <class Group>
CertifiedInitializationReport initialize_certified(PackedGraph<Group>& graph,
                                                   RotationError rotation_error,
                                                   double max_effort) {
  constexpr int dim = kSpaceDim<Group>;
  const IsotropicProblem<dim> problem = held_node_constraints(graph, rotation_error);
  if (problem.edges.empty()) {
    align_to_positions(graph);
    return {.tight = true};
  }
  const ChordalRelaxation<dim> relaxation(problem);
  Eigen::MatrixXd X = relaxation.point(graph.poses);
  const CertifiedInitializationReport report = climb(relaxation, problem.nodes, max_effort, X);
  set_poses(relaxation.round(X), graph);
  align_to_positions(graph);
  return report;
}

template <class Group>
bool certified_as_they_are(const PackedGraph<Group>& graph, RotationError rotation_error) {
  constexpr int dim = kSpaceDim<Group>;
  const IsotropicProblem<dim> problem = held_node_constraints(graph, rotation_error);
  if (problem.edges.empty()) return true;
  const ChordalRelaxation<dim> relaxation(problem);
  // With the optimal translations for the rotations the point is much nearer to critical.
  const Eigen::MatrixXd here = relaxation.round(relaxation.point(graph.poses));
  if (proves_itself(relaxation, problem.nodes, here)) return true;
  Eigen::MatrixXd X = here;
  return relaxation.minimize(X, {.max_steps = kShortDescent}).converged &&
         points_agree<dim>(here, X) && proves_itself(relaxation, problem.nodes, X);
}

#define PLACEGRAPH_INSTANTIATE(Group)                                                             \
  template CertifiedInitializationReport initialize_certified(PackedGraph<Group>&, RotationError, \
                                                              double);                            \
  template bool certified_as_they_are(const PackedGraph<Group>&, RotationError);
PLACEGRAPH_INSTANTIATE(SE2)
PLACEGRAPH_INSTANTIATE(SE3)
PLACEGRAPH_INSTANTIATE(Sim3)
#undef PLACEGRAPH_INSTANTIATE

}  // namespace placegraph
