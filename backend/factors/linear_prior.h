#pragma once
#include <placegraph/backend/factors/factor.h>

#include <Eigen/Core>
#include <vector>

namespace placegraph {

/// What marginalized variables say about the remaining ones, linearized:
///
///   r = e + sum J_k delta_k,   delta_k = x_k [-] x_k,lin
///   d r / d xi_k = J_k d delta_k / d xi_k
///
/// The derivative of [-] is the inverse right Jacobian of the group of x_k.
class LinearPriorFactor final : public Factor {
 public:
  /// The linearization points, the columns of J for all of them in order, and e.
  LinearPriorFactor(std::vector<Variable> at, Eigen::MatrixXd J, Eigen::VectorXd e);

  /// Rows of e.
  int residual_size() const override { return static_cast<int>(e_.size()); }
  /// The kinds of the linearization points.
  std::vector<std::size_t> variable_kinds() const override;
  /// The residual and its Jacobians as above; always true.
  bool evaluate(std::span<const Variable* const> values, Eigen::Ref<Eigen::VectorXd> r,
                std::span<Eigen::MatrixXd> jacobians) const override;

 private:
  std::vector<Variable> at_;
  Eigen::MatrixXd J_;
  Eigen::VectorXd e_;
};

}  // namespace placegraph
