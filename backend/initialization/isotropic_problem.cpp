#include <placegraph/backend/initialization/isotropic_problem.h>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>

namespace placegraph {
namespace {

constexpr double kEigenvalueFloor = 1e-3;  ///< relative to the mean of a block
constexpr double kWeightFloor = 1e-6;      ///< relative to the median over the edges

/// Raises weights that are (nearly) zero to a share of the median.
template <class Edges, class Weight>
void lift(Edges& edges, Weight&& weight) {
  std::vector<double> positive;
  positive.reserve(edges.size());
  for (auto& edge : edges)
    if (weight(edge) > 0) positive.push_back(weight(edge));
  double median = 1;
  if (!positive.empty()) {
    const auto middle = positive.begin() + static_cast<std::ptrdiff_t>(positive.size() / 2);
    std::nth_element(positive.begin(), middle, positive.end());
    median = *middle;
  }
  for (auto& edge : edges) weight(edge) = std::max(weight(edge), kWeightFloor * median);
}

}  // namespace

template <>
double harmonic_mean<2>(const Eigen::Matrix2d& A) {
  const double floor = kEigenvalueFloor * A.trace() / 2;
  const double a = A(0, 0) + floor, b = A(1, 1) + floor;
  const double determinant = a * b - A(0, 1) * A(1, 0);
  return determinant > 0 ? 2 * determinant / (a + b) : 0;
}

template <>
double harmonic_mean<3>(const Eigen::Matrix3d& A) {
  const double floor = kEigenvalueFloor * A.trace() / 3;
  const Eigen::Matrix3d B = A + floor * Eigen::Matrix3d::Identity();
  // tr(B^-1) is the sum of the principal minors over the determinant.
  const double minors = B(0, 0) * B(1, 1) - B(0, 1) * B(1, 0) + B(0, 0) * B(2, 2) -
                        B(0, 2) * B(2, 0) + B(1, 1) * B(2, 2) - B(1, 2) * B(2, 1);
  const double determinant = B.determinant();
  return determinant > 0 && minors > 0 ? 3 * determinant / minors : 0;
}

template <class Group>
IsotropicProblem<kSpaceDim<Group>> isotropic_problem(const PackedGraph<Group>& graph,
                                                     RotationError rotation_error,
                                                     const Eigen::VectorXd& log_scale) {
  constexpr int dim = kSpaceDim<Group>;
  const double angle_share = dim == 3 && rotation_error == RotationError::kQuaternion ? 0.125 : 0.5;
  IsotropicProblem<dim> problem;
  problem.nodes = static_cast<int>(graph.poses.size());
  problem.roots = graph.components.first;
  problem.edges.reserve(graph.edges.size());
  for (const auto& edge : graph.edges) {
    if (edge.weight == 0) continue;
    const Group T_from_to = edge.T_to_from.inverse();
    const double scale = Group::kDof == 7 && log_scale.size() ? std::exp(log_scale[edge.from]) : 1;
    problem.edges.push_back(
        {edge.from, edge.to, T_from_to.rotation().matrix(), T_from_to.translation() * scale,
         edge.weight * angle_share * rotation_information<Group>(edge.information),
         edge.weight * harmonic_mean<dim>(edge.information.template topLeftCorner<dim, dim>()) /
             (scale * scale)});
  }
  lift(problem.edges, [](auto& edge) -> double& { return edge.rotation_weight; });
  lift(problem.edges, [](auto& edge) -> double& { return edge.translation_weight; });
  return problem;
}

template <class Group>
double isotropic_cost(const IsotropicProblem<kSpaceDim<Group>>& problem,
                      const std::vector<Group>& poses) {
  double cost = 0;
  for (const auto& edge : problem.edges) {
    const auto R_from = poses[edge.from].rotation().matrix().eval();
    const auto R_to = poses[edge.to].rotation().matrix().eval();
    cost += edge.rotation_weight * (R_to - R_from * edge.R).squaredNorm() +
            edge.translation_weight *
                (poses[edge.to].translation() - poses[edge.from].translation() - R_from * edge.t)
                    .squaredNorm();
  }
  return cost;
}

SO2 nearest_rotation(const Eigen::Matrix2d& M) {
  return SO2(std::atan2(M(1, 0) - M(0, 1), M(0, 0) + M(1, 1)));
}

SO3 nearest_rotation(const Eigen::Matrix3d& M) {
  // Newton's iteration for the polar factor (Higham 1986); it is quadratic from a norm of one on.
  Eigen::Matrix3d X = M * (std::sqrt(3.0) / M.norm());
  for (int i = 0; i < 12 && X.determinant() > 1e-3; ++i) {
    const Eigen::Matrix3d next = 0.5 * (X + X.inverse().transpose());
    const double change = (next - X).squaredNorm();
    X = next;
    if (change < 1e-20) return SO3(Eigen::Quaterniond(X));
  }
  if (!M.allFinite() || M.isZero(0)) return SO3();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs(1, 1, svd.matrixU().determinant() * svd.matrixV().determinant());
  return SO3(Eigen::Quaterniond(
      Eigen::Matrix3d(svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose())));
}

#define PLACEGRAPH_INSTANTIATE(Group)                                              \
  template IsotropicProblem<kSpaceDim<Group>> isotropic_problem(                   \
      const PackedGraph<Group>&, RotationError, const Eigen::VectorXd&);           \
  template double isotropic_cost<Group>(const IsotropicProblem<kSpaceDim<Group>>&, \
                                        const std::vector<Group>&);
PLACEGRAPH_INSTANTIATE(SE2)
PLACEGRAPH_INSTANTIATE(SE3)
PLACEGRAPH_INSTANTIATE(Sim3)
#undef PLACEGRAPH_INSTANTIATE

}  // namespace placegraph
