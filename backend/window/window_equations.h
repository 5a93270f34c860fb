#pragma once
#include <placegraph/backend/window/landmark_equations.h>
#include <placegraph/backend/window/window_state.h>
#include <placegraph/graph/core/robust_kernel.h>

namespace placegraph {

/// Where the factors of a keyframe, plane or world are linearized: residuals at the estimate,
/// Jacobians at the first estimate if it is in the prior already (else at the estimate, and delta
/// is zero).
template <class T>
struct Linearized {
  using Tangent = typename VariableBlock<T>::Tangent;
  T now, lin;
  Tangent delta = Tangent::Zero();  ///< now [-] lin
  Eigen::Index column = -1;         ///< in the equations; -1: constant
};

/// The variables of a system of window equations, in the order of their columns.
struct WindowVariables {
  enum class Kind { kKeyframe, kPlane, kWorld };
  struct Variable {
    Kind kind;
    std::int64_t id;
    bool operator==(const Variable&) const = default;
  };
  std::vector<Variable> order;

  static int size(const Variable& variable) { return variable.kind == Kind::kKeyframe ? 6 : 3; }
  Eigen::Index columns() const {
    Eigen::Index n = 0;
    for (const Variable& variable : order) n += size(variable);
    return n;
  }
};

/// Gauss-Newton form of a window in the deviations delta of its keyframes, planes and worlds from
/// their linearization points; points and lines are eliminated as they come. Robust kernels enter
/// by their weights.
class WindowEquations {
 public:
  /// Any keyframe that is not among `variables` (the fixed one) is constant. With
  /// `first_estimates` what is in the prior is linearized where it was when it went there.
  WindowEquations(const WindowState& state, const WindowVariables& variables, bool first_estimates);

  void add_landmark(const WindowLandmark& landmark);
  void add_line(const WindowLine& line);
  void add_distance(const DistanceObservation& distance);
  void add_height(const HeightObservation& height);
  void add_plane_observation(const PlaneObservation& observation);
  void add_pose_prior(const PosePrior& prior);
  void add_world_observation(const WorldObservation& observation);
  void add_motion(const MotionObservation& motion);
  /// With first estimates the prior is linear in delta as it stands; else it is relinearized.
  void add_prior();

  const SE3& keyframe_lin(std::int64_t id) const { return keyframes_.at(id).lin; }
  const Plane3& plane_lin(std::int64_t id) const { return planes_.at(id).lin; }
  const SO3& world_lin(std::int64_t id) const { return worlds_.at(id).lin; }

  QuadraticForm form;

 private:
  template <class T>
  Linearized<T> linearize(const T& now, std::int64_t id, const std::vector<std::int64_t>& in_prior,
                          const std::vector<T>& lin) const;
  template <class Measurement>
  void add_measurement(const Linearized<SE3>& at, const Eigen::Vector3d& p_map,
                       const Measurement& measurement);
  Eigen::Index& column_of(const WindowVariables::Variable& variable);
  /// A factor between keyframes, planes and worlds only.
  template <class F, class... T>
  void add_factor(const F& factor, bool robust, const Linearized<T>&... at);

  const WindowState& state_;
  bool first_estimates_;
  RobustKernel kernel_;
  std::map<std::int64_t, Linearized<SE3>> keyframes_;
  std::map<std::int64_t, Linearized<Plane3>> planes_;
  std::map<std::int64_t, Linearized<SO3>> worlds_;
  LandmarkEquations<3> point_;
  LandmarkEquations<4> line_;
};

}  // namespace placegraph
