#pragma once
#include <placegraph/backend/factors/pose_error.h>
#include <placegraph/backend/solver/packed_graph.h>

namespace placegraph {

/// The isotropic chordal problem of a pose graph, over rotations R_i and translations t_i:
///
///   f = sum rotation_weight |R_j - R_i R_ij|_F^2 + translation_weight |t_j - t_i - R_i t_ij|^2
///
/// (Rosen et al. 2019, problem 1, kappa and tau). It is the basis of initializations and
/// certificates. It has every relative pose of the graph's cost, but neither the directions of
/// their information nor kernels, measured positions and fixed poses.
template <int dim>
struct IsotropicProblem {
  using Matrix = Eigen::Matrix<double, dim, dim>;
  using Vector = Eigen::Matrix<double, dim, 1>;
  struct Edge {
    int from, to;
    Matrix R;  ///< R_from_to
    Vector t;  ///< t_from_to
    double rotation_weight, translation_weight;
  };
  int nodes = 0;
  std::vector<Edge> edges;
  std::vector<int> roots;  ///< the first node of every connected component
};

template <class Group>
constexpr int kSpaceDim = Group::kDof == 3 ? 2 : 3;

/// d / tr(A^-1): the harmonic mean of the eigenvalues of a positive semi-definite 2x2 or 3x3 block
/// of an information matrix. A thousandth of their arithmetic mean is added to every eigenvalue, so
/// that a direction without information makes the mean small but not zero.
template <int dim>
double harmonic_mean(const Eigen::Matrix<double, dim, dim>& A);
template <>
double harmonic_mean<2>(const Eigen::Matrix2d& A);
template <>
double harmonic_mean<3>(const Eigen::Matrix3d& A);

/// The harmonic mean of the rotation block of an edge's information.
template <class Group>
double rotation_information(const typename Group::Jacobian& information) {
  if constexpr (Group::kDof == 3)
    return information(2, 2);
  else
    return harmonic_mean<3>(information.template block<3, 3>(3, 3));
}

/// The isotropic problem of the edges whose weight is not zero. With S_t, S_r the inverses of the
/// translation and rotation blocks of an edge's information:
///
///   translation_weight = weight d / tr(S_t)
///   rotation_weight    = weight (number of angles) / tr(S_r) / 2      (kLog, and in the plane)
///                      = weight (number of angles) / tr(S_r) / 8      (kQuaternion in space)
///
/// so that for isotropic information f is the graph's cost to second order in the rotation errors
/// (|R - R'|_F^2 = 8 sin^2(angle / 2)), and for kQuaternion in space it is that cost exactly.
/// Blocks without information have a millionth of the median weight. Sim(3): `log_scale` of every
/// node is assumed known; t_ij and its weight are scaled by it.
template <class Group>
IsotropicProblem<kSpaceDim<Group>> isotropic_problem(const PackedGraph<Group>& graph,
                                                     RotationError rotation_error,
                                                     const Eigen::VectorXd& log_scale = {});

/// f at the poses of the graph, without their scales.
template <class Group>
double isotropic_cost(const IsotropicProblem<kSpaceDim<Group>>& problem,
                      const std::vector<Group>& poses);

/// The nearest rotation to `M` in the Frobenius norm, as a group element.
SO2 nearest_rotation(const Eigen::Matrix2d& M);
SO3 nearest_rotation(const Eigen::Matrix3d& M);

}  // namespace placegraph
