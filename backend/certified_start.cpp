#include <placegraph/backend/anchors.h>
#include <placegraph/backend/certified_start.h>
#include <placegraph/backend/chordal_relaxation.h>
#include <placegraph/backend/initialization.h>

#include <algorithm>

namespace placegraph {
namespace {

constexpr int kMostLifts = 6;
/// Steps of all lifted descents together, times poses: where the relaxation is not tight they are
/// many and gain nothing.
constexpr double kLiftedEffort = 2e5;
constexpr double kFewestLiftedSteps = 20, kMostLiftedSteps = 300;
/// A lifted descent that lowers the cost by less than this share has left nothing to climb for.
constexpr double kLiftedGain = 1e-7;
constexpr double kLiftedPromiseShare = 1e-12;
constexpr double kTightGap = 1e-5;
/// A shift of the certificate matrix that costs this share of the bound is accepted unseen.
constexpr double kAcceptedShare = 1e-7;
constexpr int kShortDescent = 15;        ///< steps to a minimum that is near
constexpr double kCosineOfSame = 0.955;  ///< 0.3 rad: more than noise turns within one minimum
constexpr double kStiffness = 1e3;  ///< of ties between held nodes, in the heaviest edge's weights

template <class Group>
void tie_held_nodes(const PackedGraph<Group>& graph, const Anchors& anchors,
                    IsotropicProblem<kSpaceDim<Group>>& problem) {
  double rotation_weight = 0, translation_weight = 0;
  for (const auto& edge : problem.edges) {
    rotation_weight = std::max(rotation_weight, kStiffness * edge.rotation_weight);
    translation_weight = std::max(translation_weight, kStiffness * edge.translation_weight);
  }
  std::vector<int> last(anchors.components, -1);  // held node of the component
  for (std::size_t i = 0; i < graph.poses.size(); ++i) {
    if (!graph.held[i]) continue;
    int& previous = last[anchors.component[i]];
    if (previous >= 0) {
      const auto R_world_from = graph.poses[previous].rotation();
      const auto R_from_world = R_world_from.inverse();
      problem.edges.push_back(
          {previous, static_cast<int>(i), (R_from_world * graph.poses[i].rotation()).matrix(),
           R_from_world * (graph.poses[i].translation() - graph.poses[previous].translation()),
           rotation_weight, translation_weight});
    }
    previous = static_cast<int>(i);
  }
}

/// Rotations and translations of the point of rank d into the poses, every component moved as a
/// whole to where its first anchor stands; anchors keep their poses.
template <class Group>
void set_poses(const Eigen::MatrixXd& X, const Anchors& anchors, PackedGraph<Group>& graph) {
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
  std::vector<Motion> motions(anchors.components);
  for (std::size_t i = 0; i < graph.poses.size(); ++i) {
    Motion& motion = motions[anchors.component[i]];
    if (!anchors.anchor[i] || motion.known) continue;
    motion.known = true;
    motion.R = graph.poses[i].rotation() * rotation(i).inverse();
    motion.t = graph.poses[i].translation() - motion.R * translation(i);
  }
  for (std::size_t i = 0; i < graph.poses.size(); ++i) {
    if (anchors.anchor[i]) continue;
    const Motion& motion = motions[anchors.component[i]];
    const Rotation R = motion.R * rotation(i);
    const typename Group::Point t = motion.R * translation(i) + motion.t;
    if constexpr (Group::kDof == 7)
      graph.poses[i] = Sim3(R, t, graph.poses[i].scale());
    else
      graph.poses[i] = Group(R, t);
  }
}

/// The staircase from X, a minimum of rank d; X becomes the lower minimum of rank d.
template <int dim>
CertifiedStartReport climb(const ChordalRelaxation<dim>& relaxation, int nodes,
                           Eigen::MatrixXd& X) {
  CertifiedStartReport report;
  report.rank = dim;
  report.cost = relaxation.minimize(X).cost;
  double lifted_cost = report.cost;
  bool gained = true;
  Eigen::MatrixXd lifted = X;
  int steps =
      static_cast<int>(std::clamp(kLiftedEffort / nodes, kFewestLiftedSteps, kMostLiftedSteps));
  for (int lifts = 0;; ++lifts) {
    CertificateMatrix<dim> matrix = relaxation.certificate_matrix(lifted);
    const double accepted =
        kAcceptedShare * lifted_cost / (static_cast<double>(nodes) * dim) + 1e-13 * matrix.scale();
    const auto curvature = matrix.curvature(accepted);
    report.lower_bound = std::max(report.lower_bound, matrix.lower_bound(curvature.shift));
    report.relative_gap = matrix.relative_gap(report.cost, report.lower_bound);
    if (report.relative_gap <= kTightGap || curvature.direction.size() == 0 ||
        curvature.smallest_eigenvalue >= -10 * accepted || lifts == kMostLifts || steps <= 0 ||
        !gained)
      break;
    lifted = relaxation.escape(lifted, curvature.direction);
    const auto descent = relaxation.minimize(lifted, {steps, kLiftedPromiseShare});
    gained = descent.cost < (1 - kLiftedGain) * lifted_cost;
    lifted_cost = descent.cost;
    steps -= descent.iterations + 1;
    report.rank = static_cast<int>(lifted.rows());
  }
  if (report.rank > dim) {
    Eigen::MatrixXd rounded = relaxation.round(lifted);
    const double cost = relaxation.minimize(rounded).cost;
    if (cost < report.cost) {
      report.cost = cost;
      X = std::move(rounded);
    }
    report.relative_gap =
        relaxation.certificate_matrix(X).relative_gap(report.cost, report.lower_bound);
  }
  report.tight = report.relative_gap <= kTightGap;
  return report;
}

/// The isotropic problem of the graph, its held nodes tied to each other.
template <class Group>
IsotropicProblem<kSpaceDim<Group>> tied_problem(const PackedGraph<Group>& graph,
                                                const Anchors& anchors,
                                                RotationError rotation_error) {
  Eigen::VectorXd log_scale;
  if constexpr (Group::kDof == 7) {
    log_scale.resize(static_cast<Eigen::Index>(graph.poses.size()));
    for (Eigen::Index i = 0; i < log_scale.size(); ++i)
      log_scale[i] = std::log(graph.poses[static_cast<std::size_t>(i)].scale());
  }
  auto problem = isotropic_problem(graph, rotation_error, log_scale);
  tie_held_nodes(graph, anchors, problem);
  return problem;
}

/// Whether X is a global minimum to kTightGap, by one factorization.
template <int dim>
bool proves_itself(const ChordalRelaxation<dim>& relaxation, int nodes, const Eigen::MatrixXd& X) {
  const double cost = relaxation.cost(X);
  CertificateMatrix<dim> matrix = relaxation.certificate_matrix(X);
  const double shift =
      0.5 * kTightGap * cost / (static_cast<double>(nodes) * dim) + 1e-13 * matrix.scale();
  // No cost is below zero, whatever is proven.
  return matrix.relative_gap(cost, 0) <= kTightGap ||
         (matrix.positive_with(shift) &&
          matrix.relative_gap(cost, matrix.lower_bound(shift)) <= kTightGap);
}

/// Whether the rotations of X and Z, points of rank d, differ nowhere by more than 0.3 rad.
template <int dim>
bool rotations_agree(const Eigen::MatrixXd& X, const Eigen::MatrixXd& Z, int nodes) {
  constexpr double kTraceOfSame = dim == 2 ? 2 * kCosineOfSame : 1 + 2 * kCosineOfSame;
  const auto rotation = [](const Eigen::MatrixXd& point, int i) {
    return point.middleCols<dim>(i * (dim + 1));
  };
  for (int i = 0; i < nodes; ++i)
    if (!(rotation(X, i).cwiseProduct(rotation(Z, i)).sum() > kTraceOfSame)) return false;
  return true;
}

}  // namespace

template <class Group>
CertifiedStartReport certified_start(PackedGraph<Group>& graph, RotationError rotation_error) {
  constexpr int dim = kSpaceDim<Group>;
  const Anchors anchors = find_anchors(graph);
  const IsotropicProblem<dim> problem = tied_problem(graph, anchors, rotation_error);
  if (problem.edges.empty()) {
    align_to_positions(graph);
    return {.tight = true};
  }
  const ChordalRelaxation<dim> relaxation(problem);
  Eigen::MatrixXd X = relaxation.point(graph.poses);
  const CertifiedStartReport report = climb(relaxation, problem.nodes, X);
  set_poses(relaxation.round(X), anchors, graph);
  align_to_positions(graph);
  return report;
}

template <class Group>
bool certified_as_they_are(const PackedGraph<Group>& graph, RotationError rotation_error) {
  constexpr int dim = kSpaceDim<Group>;
  const IsotropicProblem<dim> problem = tied_problem(graph, find_anchors(graph), rotation_error);
  if (problem.edges.empty()) return true;
  const ChordalRelaxation<dim> relaxation(problem);
  // With the translations best for the rotations, the multipliers are far nearer to critical.
  const Eigen::MatrixXd here = relaxation.round(relaxation.point(graph.poses));
  if (proves_itself(relaxation, problem.nodes, here)) return true;
  Eigen::MatrixXd X = here;
  return relaxation.minimize(X, {.max_steps = kShortDescent}).converged &&
         rotations_agree<dim>(here, X, problem.nodes) &&
         proves_itself(relaxation, problem.nodes, X);
}

#define PLACEGRAPH_INSTANTIATE(Group)                                                \
  template CertifiedStartReport certified_start(PackedGraph<Group>&, RotationError); \
  template bool certified_as_they_are(const PackedGraph<Group>&, RotationError);
PLACEGRAPH_INSTANTIATE(SE2)
PLACEGRAPH_INSTANTIATE(SE3)
PLACEGRAPH_INSTANTIATE(Sim3)
#undef PLACEGRAPH_INSTANTIATE

}  // namespace placegraph
