#include <placegraph/backend/factors/linear_prior.h>

#include <type_traits>
#include <utility>

namespace placegraph {
namespace {

/// d delta / d xi of delta = (x [+] xi) [-] x_lin at xi = 0.
Eigen::MatrixXd derivative_of_minus(const Variable& x, const Eigen::VectorXd& delta) {
  return std::visit(
      [&](const auto& value) -> Eigen::MatrixXd {
        using T = std::decay_t<decltype(value)>;
        if constexpr (std::is_same_v<T, double> || std::is_same_v<T, Eigen::Vector3d>) {
          return Eigen::MatrixXd::Identity(delta.size(), delta.size());
        } else if constexpr (std::is_same_v<T, Line3>) {
          Eigen::MatrixXd derivative = Eigen::MatrixXd::Identity(4, 4);
          derivative.topLeftCorner<3, 3>() = SO3::right_jacobian_inverse(delta.head<3>());
          return derivative;
        } else if constexpr (std::is_same_v<T, Plane3>) {
          return SO3::right_jacobian_inverse(delta);
        } else if constexpr (std::is_same_v<T, Marker>) {
          return SE3::right_jacobian_inverse(delta);
        } else {
          return T::right_jacobian_inverse(delta);
        }
      },
      x);
}

}  // namespace

LinearPriorFactor::LinearPriorFactor(std::vector<Variable> at, Eigen::MatrixXd J, Eigen::VectorXd e)
    : at_(std::move(at)), J_(std::move(J)), e_(std::move(e)) {}

std::vector<std::size_t> LinearPriorFactor::variable_kinds() const {
  std::vector<std::size_t> kinds;
  for (const Variable& point : at_) kinds.push_back(point.index());
  return kinds;
}

bool LinearPriorFactor::evaluate(std::span<const Variable* const> values,
                                 Eigen::Ref<Eigen::VectorXd> r,
                                 std::span<Eigen::MatrixXd> jacobians) const {
  r = e_;
  Eigen::Index first = 0;
  for (std::size_t k = 0; k < at_.size(); ++k) {
    const Eigen::VectorXd delta = minus(*values[k], at_[k]);
    const auto J_k = J_.middleCols(first, delta.size());
    r.noalias() += J_k * delta;
    if (!jacobians.empty()) jacobians[k].noalias() = J_k * derivative_of_minus(*values[k], delta);
    first += delta.size();
  }
  return true;
}

}  // namespace placegraph
