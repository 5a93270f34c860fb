#pragma once
#include <placegraph/backend/internal/window/landmark_equations.h>
#include <placegraph/backend/internal/window/window_state.h>
#include <placegraph/graph/core/robust_kernel.h>

namespace placegraph {

/// Number of columns of variables one after the other.
Eigen::Index columns_of(const std::vector<WindowVariable>& variables);

/// Where the factors of a variable are linearized: residuals at the estimate, Jacobians at the
/// first estimate if it is in the prior already (else at the estimate, and delta is zero).
struct LinearizedVariable {
  Variable now, lin;
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1> delta;  ///< now [-] lin
  Eigen::Index column = -1;                                 ///< in the equations; -1: constant
};

/// Gauss-Newton form of a window in the deviations delta of its keyframes, planes and worlds from
/// their linearization points; points and lines are eliminated as they come. Robust kernels enter
/// by their weights.
class WindowEquations {
 public:
  /// The columns stand in the order of `variables`; any other variable of the window (the fixed
  /// keyframe) is constant. With `first_estimates` what is in the prior is linearized where it was
  /// when it went there.
  WindowEquations(const WindowState& state, const std::vector<WindowVariable>& variables,
                  bool first_estimates);

  void add_landmark(const WindowLandmark& landmark);
  void add_line(const WindowLine& line);
  void add(const WindowFactor& factor);
  /// With first estimates the prior is linear in delta as it stands; else it is relinearized.
  void add_prior();

  /// Where a variable is linearized.
  const Variable& linearization_point(const WindowVariable& variable) const {
    return variables_.at(variable).lin;
  }

  QuadraticForm form;

 private:
  template <class Measurement>
  void add_measurement(const LinearizedVariable& at, const Eigen::Vector3d& p_map,
                       const Measurement& measurement);

  const WindowState& state_;
  bool first_estimates_;
  RobustKernel kernel_;
  std::map<WindowVariable, LinearizedVariable> variables_;
  LandmarkEquations<3> point_;
  LandmarkEquations<4> line_;
};

}  // namespace placegraph
