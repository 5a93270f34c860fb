#include <Spectra/SymEigsSolver.h>
#include <placegraph/backend/initialization/certificate_matrix.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace placegraph {
namespace {

/// A cost below this share of n d scale (residuals of 3e-5 rad) is regarded as zero; the gap is
/// then relative to this share.
constexpr double kCostFloor = 1e-9;
/// A matrix that is not positive with a shift of this multiple of its scale is not finite.
constexpr double kLargestShift = 1e9;

/// (Schur complement of the certificate matrix on the rotations + shift)^-1, for Spectra.
template <int dim>
class InverseOfShifted {
 public:
  using Scalar = double;
  explicit InverseOfShifted(const BlockCholesky& factor) : factor_(factor) {}
  Eigen::Index rows() const { return static_cast<Eigen::Index>(factor_.block_count()) * dim; }
  Eigen::Index cols() const { return rows(); }
  void perform_op(const double* in, double* out) const {
    const Eigen::VectorXd x = solve(Eigen::Map<const Eigen::VectorXd>(in, rows()));
    for (int i = 0; i < factor_.block_count(); ++i)
      Eigen::Map<Eigen::Matrix<double, dim, 1>>(out + i * dim) = x.segment<dim>(i * (dim + 1));
  }
  /// All unknowns, translations included.
  Eigen::VectorXd solve(const Eigen::Ref<const Eigen::VectorXd>& rotations) const {
    Eigen::MatrixXd x =
        Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(factor_.block_count()) * (dim + 1), 1);
    for (int i = 0; i < factor_.block_count(); ++i)
      x.block<dim, 1>(i * (dim + 1), 0) = rotations.segment<dim>(i * dim);
    factor_.solve(x);
    return x;
  }

 private:
  const BlockCholesky& factor_;
};

template <class Edges>
std::vector<std::pair<int, int>> pairs(const Edges& edges) {
  std::vector<std::pair<int, int>> pairs;
  pairs.reserve(edges.size());
  for (const auto& edge : edges) pairs.emplace_back(edge.from, edge.to);
  return pairs;
}

}  // namespace

template <int dim>
CertificateMatrix<dim>::CertificateMatrix(const IsotropicProblem<dim>& problem,
                                          const BlockOrdering& ordering,
                                          const Multipliers& multipliers)
    : problem_(problem), matrix_(problem.nodes, dim + 1, pairs(problem.edges), ordering) {
  using Block = Eigen::Matrix<double, dim + 1, dim + 1>;
  const auto add = [&](int i, int j, const Block& block) {
    const BlockCholesky::Slot slot = matrix_.slot(i, j);
    Eigen::Map<Block, 0, Eigen::OuterStride<>> kept(slot.first, Eigen::OuterStride<>(slot.stride));
    kept += slot.transposed ? Block(block.transpose()) : block;
  };
  matrix_.set_zero();
  for (const auto& edge : problem.edges) {
    const double kappa = edge.rotation_weight, tau = edge.translation_weight;
    Block from = Block::Zero(), to = Block::Zero(), cross = Block::Zero();
    to.diagonal().template head<dim>().setConstant(kappa);
    to(dim, dim) = tau;
    from = to;
    from.template topLeftCorner<dim, dim>() += tau * edge.t * edge.t.transpose();
    from.template topRightCorner<dim, 1>() = tau * edge.t;
    from.template bottomLeftCorner<1, dim>() = tau * edge.t.transpose();
    cross.template topLeftCorner<dim, dim>() = -kappa * edge.R;
    cross.template topRightCorner<dim, 1>() = -tau * edge.t;
    cross(dim, dim) = -tau;
    add(edge.from, edge.from, from);
    add(edge.to, edge.to, to);
    add(edge.from, edge.to, cross);
    scale_ += (from.diagonal().template head<dim>().mean() + kappa) / problem.nodes;
    pin_ += 2 * tau / problem.nodes;
  }
  for (int i = 0; i < problem.nodes; ++i) {
    Block block = Block::Zero();
    block.template topLeftCorner<dim, dim>() = -multipliers[i];
    add(i, i, block);
    dual_value_ += multipliers[i].trace();
  }
}

template <int dim>
bool CertificateMatrix<dim>::factorize(double shift) {
  // The translations of a component have a common free translation; fixing one of them removes it.
  Eigen::VectorXd added =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(problem_.nodes) * (dim + 1));
  for (int i = 0; i < problem_.nodes; ++i) added.segment<dim>(i * (dim + 1)).setConstant(shift);
  for (const int root : problem_.roots) added[root * (dim + 1) + dim] = pin_ > 0 ? pin_ : 1;
  return matrix_.factorize(added);
}

template <int dim>
typename CertificateMatrix<dim>::Curvature CertificateMatrix<dim>::curvature(double accepted_shift,
                                                                             int max_restarts) {
  Curvature curvature;
  curvature.shift = accepted_shift;
  if (accepted_shift > 0 && factorize(accepted_shift)) {
    curvature.smallest_eigenvalue = -accepted_shift;
    return curvature;
  }
  const double floor = scale_ > 0 ? 1e-12 * scale_ : 1;
  double shift = std::max(4 * accepted_shift, 100 * floor);
  curvature.factorizations = 2;
  for (; !factorize(shift); shift *= 8, ++curvature.factorizations) {
    if (shift < kLargestShift * std::max(scale_, 1.0)) continue;
    curvature.shift = std::numeric_limits<double>::infinity();
    curvature.smallest_eigenvalue = -curvature.shift;
    return curvature;
  }
  InverseOfShifted<dim> inverse(matrix_);
  Spectra::SymEigsSolver<InverseOfShifted<dim>> lanczos(
      inverse, 1, static_cast<int>(std::min<Eigen::Index>(inverse.rows(), 24)));
  lanczos.init();
  lanczos.compute(Spectra::SortRule::LargestAlge, max_restarts, 1e-8);
  curvature.solutions = static_cast<int>(lanczos.num_operations());
  curvature.shift = shift;
  curvature.smallest_eigenvalue = -shift;
  if (lanczos.info() != Spectra::CompInfo::Successful) return curvature;
  const double largest = lanczos.eigenvalues()[0];
  curvature.smallest_eigenvalue = 1 / largest - shift;
  curvature.direction = inverse.solve(lanczos.eigenvectors().col(0)) / largest;
  // The eigenvalue is proven by a factorization. The shift is slightly above it, and at least the
  // rounding of a row of some hundred entries.
  for (const double rounding : {0.1 * floor, floor}) {
    const double proven = std::max(0.0, -curvature.smallest_eigenvalue) * 1.001 + rounding;
    if (proven >= shift || !factorize(proven)) continue;
    ++curvature.factorizations;
    curvature.shift = proven;
    break;
  }
  return curvature;
}

template <int dim>
double CertificateMatrix<dim>::lower_bound(double shift) const {
  return dual_value_ - static_cast<double>(problem_.nodes) * dim * shift;
}

template <int dim>
double CertificateMatrix<dim>::relative_gap(double cost, double lower_bound) const {
  const double floor = kCostFloor * problem_.nodes * dim * scale_;
  if (!std::isfinite(cost)) return 1;
  if (!std::isfinite(lower_bound)) lower_bound = 0;  // no cost is below zero
  return std::max(0.0, cost - lower_bound) / std::max(cost, floor);
}

template class CertificateMatrix<2>;
template class CertificateMatrix<3>;

}  // namespace placegraph
