#pragma once
#include <placegraph/backend/factors/variable.h>

#include <array>
#include <memory>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A term of a factor graph: a whitened residual r of a few variables, with its derivatives.
/// The graph minimizes the sum of rho(|r|^2) / 2. Derive from this class or, more simply, from
/// SizedFactor. A factor must not change once it is in a graph.
class Factor {
 public:
  virtual ~Factor() = default;

  /// Number of rows of r, at least 1.
  virtual int residual_size() const = 0;
  /// The kinds of the variables, in order: indices of the alternatives of Variable.
  virtual std::vector<std::size_t> variable_kinds() const = 0;
  /// Writes r and, if `jacobians` is not empty, its derivatives by the variables' tangents.
  /// There is one Jacobian for each variable, residual_size x degrees_of_freedom, with
  /// T [+] xi = T exp(xi); all sizes are already set. Returns false if the residual cannot be
  /// computed; the solver then tries a shorter step.
  virtual bool evaluate(std::span<const Variable* const> values, Eigen::Ref<Eigen::VectorXd> r,
                        std::span<Eigen::MatrixXd> jacobians) const = 0;
  /// The same measurement in another world frame and scale, p_new = S_new_old p_old.
  /// Its residual at the variables in the new frame equals that of this factor at the variables in
  /// the old one. Null (the default) if the factor does not support it: such a factor cannot be
  /// used in a sliding window, which is moved and rescaled.
  virtual std::shared_ptr<const Factor> transformed(const Sim3& S_new_old) const {
    static_cast<void>(S_new_old);
    return nullptr;
  }
};

/// The derivative of `Rows` residuals by the tangent of one variable.
template <int Rows, class T>
using FactorJacobian = Eigen::Matrix<double, Rows, VariableBlock<T>::kDof>;

/// A factor whose sizes and variables are known at compile time:
///
///     class Range final : public SizedFactor<1, SE3, Eigen::Vector3d> {
///       bool compute(const SE3& T_world_body, const Eigen::Vector3d& p_world, Residual& r,
///                    Jacobians* J) const override { ... std::get<1>(*J) = ...; return true; }
///     };
///
/// `J` is null if no derivatives are requested; the Jacobians it points to are uninitialized.
template <int Rows, class... Variables>
class SizedFactor : public Factor {
 public:
  static constexpr int kRows = Rows;  ///< number of rows of the residual
  /// The types of the variables, in order.
  using VariableTuple = std::tuple<Variables...>;
  /// The whitened residual.
  using Residual = Eigen::Matrix<double, Rows, 1>;
  /// The derivatives of the residual by the tangents of the variables, in order.
  using Jacobians = std::tuple<FactorJacobian<Rows, Variables>...>;

  /// Writes the residual and, unless `J` is null, all derivatives, as Factor::evaluate.
  /// Returns false where the residual cannot be computed.
  virtual bool compute(const Variables&... variables, Residual& r, Jacobians* J) const = 0;

  /// `Rows`.
  int residual_size() const final { return Rows; }
  /// The indices of `Variables` among the alternatives of Variable.
  std::vector<std::size_t> variable_kinds() const final {
    return {Variable(std::in_place_type<Variables>).index()...};
  }
  /// Calls compute(); the values must be of the kinds of the variables.
  bool evaluate(std::span<const Variable* const> values, Eigen::Ref<Eigen::VectorXd> r,
                std::span<Eigen::MatrixXd> jacobians) const final {
    return evaluate_all(values, r, jacobians, std::index_sequence_for<Variables...>());
  }

 private:
  template <std::size_t... I>
  bool evaluate_all(std::span<const Variable* const> values, Eigen::Ref<Eigen::VectorXd> r,
                    std::span<Eigen::MatrixXd> jacobians, std::index_sequence<I...>) const {
    Residual residual;
    Jacobians J;
    if (!compute(std::get<Variables>(*values[I])..., residual, jacobians.empty() ? nullptr : &J))
      return false;
    Eigen::Map<Residual>{r.data()} = residual;
    if (!jacobians.empty())
      ((Eigen::Map<FactorJacobian<Rows, Variables>>(jacobians[I].data()) = std::get<I>(J)), ...);
    return true;
  }
};

}  // namespace placegraph
