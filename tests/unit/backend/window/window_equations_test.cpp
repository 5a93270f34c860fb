#include <gtest/gtest.h>
#include <placegraph/backend/window/window_equations.h>

#include <Eigen/Dense>

#include "tests/support/scenes/window_factors.h"

namespace placegraph {
namespace window_equations_test {

using test::factors_of_every_kind;
using test::FactorScene;
using test::motion_information;

void move(WindowState& state, const WindowVariable& variable, const Eigen::VectorXd& xi) {
  switch (variable.kind) {
    case WindowVariable::Kind::kPlane:
      state.planes.at(PlaneId(variable.id)) = state.planes.at(PlaneId(variable.id)).plus(xi);
      break;
    case WindowVariable::Kind::kManhattanFrame:
      state.manhattan_frames.at(ManhattanFrameId(variable.id)) =
          state.manhattan_frames.at(ManhattanFrameId(variable.id)).plus(xi);
      break;
    default:
      state.keyframes.at(KeyframeId(variable.id)) =
          state.keyframes.at(KeyframeId(variable.id)).plus(xi);
  }
}

/// The derivative of a factor's residual by the variables, by differences.
Eigen::MatrixXd numeric_jacobian(const WindowState& state, const WindowFactor& factor,
                                 const std::vector<WindowVariable>& variables) {
  Eigen::MatrixXd J(factor.factor->residual_size(), columns_of(variables));
  Eigen::Index column = 0;
  for (const WindowVariable& variable : variables)
    for (int i = 0; i < degrees_of_freedom(variable); ++i) {
      constexpr double kStep = 1e-6;
      WindowState ahead = state, behind = state;
      const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(degrees_of_freedom(variable), i);
      move(ahead, variable, step);
      move(behind, variable, -step);
      J.col(column++) = (*residual(ahead, factor) - *residual(behind, factor)) / (2 * kStep);
    }
  return J;
}

TEST(WindowEquations, AreTheNormalEquationsOfAFactorOfEveryKind) {
  const FactorScene scene;
  SlidingWindowOptions options;
  options.huber_px = 0.5;  // so that robust ones weigh less
  const SlidingWindow window = scene.window(options);
  const WindowState& state = window.state();
  const std::vector<WindowVariable> variables{
      manhattan_variable(FactorScene::kManhattanFrame), keyframe_variable(KeyframeId(2)),
      plane_variable(FactorScene::kPlane), keyframe_variable(KeyframeId(1)),
      keyframe_variable(KeyframeId(0))};
  for (const auto& [name, factor] : factors_of_every_kind(scene)) {
    WindowEquations equations(state, variables, false);
    equations.add(factor);
    const Eigen::VectorXd r = *residual(state, factor);
    ASSERT_GT(r.norm(), 0.5) << name;
    const double w = factor.robust ? 0.5 / r.norm() : 1;
    const Eigen::MatrixXd J = numeric_jacobian(state, factor, variables);
    const Eigen::MatrixXd H = w * J.transpose() * J;
    const Eigen::VectorXd b = w * J.transpose() * r;
    EXPECT_LT((equations.form.H - H).norm(), 1e-6 * H.norm()) << name;
    EXPECT_LT((equations.form.b - b).norm(), 1e-6 * b.norm()) << name;
  }
}

TEST(WindowEquations, HaveNoColumnsOfAVariableThatIsNotAskedFor) {
  const FactorScene scene;
  const SlidingWindow window = scene.window({});
  for (const auto& [name, factor] : factors_of_every_kind(scene)) {
    WindowEquations all(window.state(),
                        {keyframe_variable(KeyframeId(0)), keyframe_variable(KeyframeId(1))},
                        false);
    WindowEquations one(window.state(), {keyframe_variable(KeyframeId(1))}, false);
    all.add(factor);
    one.add(factor);
    EXPECT_TRUE(all.form.H.leftCols<6>().isZero(0)) << name << " is not of keyframe 0";
    EXPECT_EQ(one.form.H, (all.form.H.bottomRightCorner<6, 6>())) << name;
    EXPECT_EQ(one.form.b, all.form.b.tail<6>()) << name;
  }
}

TEST(WindowEquations, TakeDerivativesAtTheFirstEstimateAndResidualsAtTheLast) {
  // A factor in the equations is r_now + J_lin (delta - delta_now): at delta_now it has the
  // residual of the estimate.
  const FactorScene scene;
  SlidingWindow window = scene.window({});
  const WindowVariable keyframe = keyframe_variable(KeyframeId(1)),
                       plane = plane_variable(FactorScene::kPlane);
  const std::vector<WindowVariable> variables{keyframe, plane};
  for (const auto& [name, factor] : factors_of_every_kind(scene)) {
    WindowState state = window.state();
    state.prior.keyframes = {KeyframeId(1)};
    state.prior.T_map_cam_lin = {scene.T_map_cam[1]};
    state.prior.planes = {FactorScene::kPlane};
    state.prior.plane_lin = {scene.plane};
    const WindowState first = state;
    const Vector6d xi = (Vector6d() << 0.05, -0.02, 0.03, 0.01, 0.02, -0.01).finished();
    const Eigen::Vector3d rotation(0.01, -0.02, 0.01);
    move(state, keyframe, xi);
    move(state, plane, rotation);
    WindowEquations equations(state, variables, true);
    WindowFactor plain = factor;
    plain.robust = false;
    equations.add(plain);
    const Eigen::MatrixXd J = numeric_jacobian(first, factor, variables);
    Eigen::VectorXd delta(9);
    delta << xi, rotation;
    const Eigen::VectorXd b = J.transpose() * (*residual(state, factor) - J * delta);
    EXPECT_LT((equations.form.b - b).norm(), 1e-5 * (J.transpose() * J * delta).norm() + 1e-6)
        << name;
    EXPECT_LT((equations.form.H - J.transpose() * J).norm(), 1e-6 * (J.transpose() * J).norm())
        << name;
  }
}

TEST(WindowEquations, HoldThePriorAsItStandsWithFirstEstimates) {
  const FactorScene scene;
  WindowState state = scene.window({}).state();
  state.prior.keyframes = {KeyframeId(1)};
  state.prior.T_map_cam_lin = {scene.T_map_cam[1]};
  state.prior.J = Eigen::MatrixXd::Random(4, 6);
  state.prior.e = Eigen::VectorXd::Random(4);
  move(state, keyframe_variable(KeyframeId(1)), Vector6d::Constant(0.1));
  WindowEquations linear(state, {keyframe_variable(KeyframeId(1))}, true);
  linear.add_prior();
  EXPECT_LT((linear.form.H - state.prior.J.transpose() * state.prior.J).norm(), 1e-12);
  EXPECT_LT((linear.form.b - state.prior.J.transpose() * state.prior.e).norm(), 1e-12);
  EXPECT_TRUE(
      std::holds_alternative<SE3>(linear.linearization_point(keyframe_variable(KeyframeId(1)))));
  // Without them it is linearized at the estimate, which has moved by 0.1.
  WindowEquations anew(state, {keyframe_variable(KeyframeId(1))}, false);
  anew.add_prior();
  const Eigen::VectorXd r = state.prior.e + state.prior.J * Vector6d::Constant(0.1);
  const Matrix6d J_delta = SE3::right_jacobian_inverse(Vector6d::Constant(0.1));
  EXPECT_LT((anew.form.b - (state.prior.J * J_delta).transpose() * r).norm(), 1e-9);
}

}  // namespace window_equations_test
}  // namespace placegraph
