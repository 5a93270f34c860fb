#pragma once
#include <placegraph/backend/window/landmark_equations.h>
#include <placegraph/backend/window/window_state.h>
#include <placegraph/graph/core/robust_kernel.h>

#include <optional>

namespace placegraph {

/// Total number of columns of variables.
Eigen::Index columns_of(const std::vector<WindowVariable>& variables);

/// The linearization of a variable in its factors.
/// Residuals are at the estimate, Jacobians at the first estimate if the variable is already in the
/// prior (else at the estimate, and delta is zero).
struct LinearizedVariable {
  Variable now, lin;
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1> delta;  ///< estimate [-] lin
  Eigen::Index column = -1;  ///< first column in the equations; -1: constant
};

/// Gauss-Newton form of a window in the deviations delta of its variables.
/// The deviations are those of keyframes, planes and Manhattan frames from their linearization
/// points; points and lines are eliminated when they are added. Robust kernels enter by their
/// weights.
class WindowEquations {
 public:
  /// The columns are in the order of `variables`; any other variable of the window (the fixed
  /// keyframe) is constant. With `first_estimates` the variables in the prior are linearized at
  /// their values when they entered it.
  WindowEquations(const WindowState& state, const std::vector<WindowVariable>& variables,
                  bool first_estimates);

  /// Also forms the sums of `images` when landmarks and lines are added from now on.
  void collect_image_sums() { images.emplace(form.H.cols()); }
  void add_landmark(const WindowLandmark& landmark);
  void add_line(const WindowLine& line);
  void add(const WindowFactor& factor);
  /// Adds the prior. With first estimates it is linear in delta; else it is relinearized.
  void add_prior();

  /// The linearization point of a variable.
  const Variable& linearization_point(const WindowVariable& variable) const {
    return variables_.at(variable).lin;
  }

  QuadraticForm form;
  std::optional<ImageSums> images;

 private:
  template <class Measurement>
  void add_measurement(const LinearizedVariable& at, const Eigen::Vector3d& p_map,
                       const Measurement& measurement, const std::optional<Vector6d>& velocity);
  ImageSums* sums() { return images ? &*images : nullptr; }

  const WindowState& state_;
  bool first_estimates_;
  RobustKernel kernel_;
  std::map<WindowVariable, LinearizedVariable> variables_;
  LandmarkEquations<3> point_;
  LandmarkEquations<4> line_;
};

}  // namespace placegraph
