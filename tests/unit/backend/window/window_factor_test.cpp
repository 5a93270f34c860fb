#include <gtest/gtest.h>
#include <placegraph/backend/factors/bearing.h>
#include <placegraph/backend/factors/distance.h>
#include <placegraph/backend/factors/plane_orthogonal.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Dense>
#include <algorithm>
#include <typeinfo>

#include "tests/support/ids.h"
#include "tests/support/scenes/window_factors.h"

namespace placegraph {
namespace window_factor_test {

using test::distance_m;
using test::factors_of_every_kind;
using test::FactorScene;
using test::motion_information;

SlidingWindowOptions exact_options(int max_keyframes = 20) {
  SlidingWindowOptions options;
  options.max_keyframes = max_keyframes;
  options.max_iterations = 100;
  options.relative_decrease = 1e-16;
  options.huber_px = 50;
  return options;
}

/// A measured motion between any two neighbours, as they are.
void add_chain(SlidingWindow& window, const FactorScene& scene) {
  for (std::size_t k = 1; k < scene.T_map_cam.size(); ++k) {
    const auto to = static_cast<std::int64_t>(k);
    add_motion(window,
               {KeyframeId(to - 1), KeyframeId(to), scene.motion(k - 1, k), motion_information()});
  }
}

/// What ties the plane and the world to the last keyframes, so that they stay.
void add_observations(SlidingWindow& window, const FactorScene& scene) {
  const Eigen::Matrix3d I = 1e4 * Eigen::Matrix3d::Identity();
  for (const std::size_t k : {2, 3}) {
    const auto id = static_cast<std::int64_t>(k);
    const SE3& T = scene.T_map_cam[k];
    add_plane_observation(window,
                          {KeyframeId(id), FactorScene::kPlane, transform_to(T, scene.plane), I});
    add_manhattan_observation(window, {KeyframeId(id), FactorScene::kManhattanFrame,
                                       T.rotation().inverse() * scene.R_map_manhattan, I});
  }
}

bool contains(const SlidingWindow& window, const WindowFactor& factor) {
  return std::any_of(window.factors().begin(), window.factors().end(),
                     [&](const WindowFactor& other) { return other.factor == factor.factor; });
}

Variable moved(const Variable& variable, const Sim3& S) {
  const SE3 T(S.rotation(), S.translation());
  if (const auto* pose = std::get_if<SE3>(&variable))
    return SE3(S.rotation() * pose->rotation(), S * pose->translation());
  if (const auto* rotation = std::get_if<SO3>(&variable)) return S.rotation() * *rotation;
  const Plane3& plane = std::get<Plane3>(variable);
  return transform_to(T.inverse(), Plane3(plane.normal(), S.scale() * plane.distance()));
}

/// The residual of `factor` at the scene's variables, after S.
Eigen::VectorXd residual_at(const SlidingWindow& window, const WindowFactor& factor,
                            const Sim3& S) {
  std::vector<Variable> values;
  std::vector<const Variable*> pointers;
  for (const WindowVariable& variable : factor.variables)
    values.push_back(moved(value_of(window.state(), variable), S));
  for (const Variable& value : values) pointers.push_back(&value);
  Eigen::VectorXd r(factor.factor->residual_size());
  EXPECT_TRUE(factor.factor->evaluate(pointers, r, {}));
  return r;
}

TEST(WindowFactor, OfEveryKindReadsTheSameInAnotherFrame) {
  const FactorScene scene;
  const SlidingWindow window = scene.window({});
  const Sim3 S(SO3::exp({0.4, -0.7, 0.2}), Eigen::Vector3d(3, -2, 5), 1);
  for (const auto& [name, factor] : factors_of_every_kind(scene)) {
    const Eigen::VectorXd r = residual_at(window, factor, Sim3());
    EXPECT_GT(r.norm(), 0.5) << name << " tests nothing";
    EXPECT_LT((residual_at(window, transformed(factor, S), S) - r).norm(), 1e-9) << name;
  }
}

TEST(WindowFactor, OfEveryKindReadsTheSameInAnotherUnitOfLength) {
  const FactorScene scene;
  const SlidingWindow window = scene.window({});
  for (const double scale : {0.2, 7.0}) {
    const Sim3 S(SO3::exp({0.4, -0.7, 0.2}), Eigen::Vector3d(3, -2, 5), scale);
    for (const auto& [name, factor] : factors_of_every_kind(scene)) {
      const Eigen::VectorXd r = residual_at(window, factor, Sim3());
      // The tangent of a plane bends with the unit: what is left is of second order of 0.014.
      const double tolerance = name == "plane" ? 0.05 * r.norm() : 1e-9;
      EXPECT_LT((residual_at(window, transformed(factor, S), S) - r).norm(), tolerance) << name;
    }
  }
}

TEST(WindowFactor, OfEveryKindIsInTheCostOnceItIsAdded) {
  const FactorScene scene;
  for (const auto& [name, factor] : factors_of_every_kind(scene)) {
    SlidingWindow window = scene.window(exact_options());
    add_chain(window, scene);
    add_observations(window, scene);
    const std::size_t before = window.factors().size();
    window.add(factor);
    ASSERT_EQ(window.factors().size(), before + 1) << name;
    EXPECT_TRUE(contains(window, factor)) << name;
    const double expected = 0.5 * residual_sigmas(window, factor)->squaredNorm();
    const WindowSummary summary = window.optimize();
    ASSERT_TRUE(summary.outcome) << name << ": " << summary.outcome.reason;
    EXPECT_NEAR(summary.cost_initial, expected, 1e-9) << name;
    EXPECT_LT(summary.cost_final, 0.9 * expected) << name << " pulls at nothing";
  }
}

TEST(WindowFactor, IsUnderTheKernelIfItIsRobust) {
  const FactorScene scene;
  for (const auto& [name, factor] : factors_of_every_kind(scene)) {
    SlidingWindowOptions options = exact_options();
    options.huber_px = 0.5;
    SlidingWindow window = scene.window(options);
    add_chain(window, scene);
    add_observations(window, scene);
    window.add(factor);
    const double r = residual_sigmas(window, factor)->norm();
    ASSERT_GT(r, 0.5) << name;
    const double expected = 0.5 * (factor.robust ? 2 * 0.5 * r - 0.25 : r * r);  // Huber
    EXPECT_NEAR(window.optimize().cost_initial, expected, 1e-9) << name;
  }
}

TEST(WindowFactor, OfEveryKindIsForgottenOnceItIsRemoved) {
  const FactorScene scene;
  for (const auto& [name, factor] : factors_of_every_kind(scene)) {
    SlidingWindow window = scene.window(exact_options());
    add_chain(window, scene);
    const Matrix6d without = relative_information(window, KeyframeId(1), KeyframeId(2));
    window.add(factor);
    const WindowFactor twin = transformed(factor, Sim3());
    window.add(twin);
    window.remove(twin);
    EXPECT_TRUE(contains(window, factor)) << name << ": of two this one";
    EXPECT_THROW(window.remove(twin), ArgumentError);
    window.remove(factor);
    EXPECT_EQ(window.factors().size(), 3u);
    EXPECT_EQ(relative_information(window, KeyframeId(1), KeyframeId(2)), without) << name;
  }
}

TEST(WindowFactor, OfEveryKindGoesIntoThePriorWithTheFirstOfItsKeyframesThatLeaves) {
  // Marginalized at the minimum, everything stays as it is; what is added later then pulls as it
  // does in a window that has kept all, but for the second order of a pull of a millimetre.
  const FactorScene scene;
  for (const auto& [name, factor] : factors_of_every_kind(scene)) {
    SlidingWindow all = scene.window(exact_options(4), 1);
    SlidingWindow few = scene.window(exact_options(2), 1);
    for (SlidingWindow* const window : {&all, &few}) {
      add_chain(*window, scene);
      add_observations(*window, scene);
      window->add(factor);
      ASSERT_TRUE(window->optimize().outcome);
    }
    EXPECT_EQ(few.marginalize(), test::ids<KeyframeId>({0, 1})) << name;
    EXPECT_FALSE(contains(few, factor)) << name;
    const Matrix6d expected = relative_information(all, KeyframeId(2), KeyframeId(3));
    EXPECT_LT((relative_information(few, KeyframeId(2), KeyframeId(3)) - expected).norm(),
              1e-6 * expected.norm())
        << name;
    SE3 pulled = scene.motion(2, 3).plus((Vector6d() << 1e-3, 0, 1e-3, 0, 1e-3, 0).finished());
    for (SlidingWindow* const window : {&all, &few}) {
      add_motion(*window, {KeyframeId(2), KeyframeId(3), pulled, motion_information()});
      ASSERT_TRUE(window->optimize().outcome);
    }
    for (const std::int64_t k : {2, 3})
      EXPECT_LT(distance_m(few.pose(KeyframeId(k)), all.pose(KeyframeId(k))), 2e-5)
          << name << ", keyframe " << k;
  }
}

TEST(WindowFactor, StandsWithThoseOfItsTypeInTheOrderInWhichTheyCame) {
  const FactorScene scene;
  SlidingWindow window = scene.window({});
  const auto kinds = factors_of_every_kind(scene);
  for (int round = 0; round < 2; ++round)
    for (const auto& [name, factor] : kinds)
      window.add(round == 0 ? factor : transformed(factor, Sim3()));
  ASSERT_EQ(window.factors().size(), 2 * kinds.size());
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    const Factor &first = *window.factors()[2 * k].factor,
                 &then = *window.factors()[2 * k + 1].factor;
    EXPECT_EQ(&first, kinds[k].second.factor.get()) << kinds[k].first;
    EXPECT_EQ(typeid(then), typeid(first)) << kinds[k].first;
  }
}

TEST(WindowFactor, OfAKindThatNobodyKnowsKeepsItsPlaneAndMovesTheKeyframe) {
  const FactorScene scene;
  SlidingWindow window = scene.window(exact_options(3));
  add_chain(window, scene);
  const WindowFactor step = factors_of_every_kind(scene).back().second;
  window.add(step);
  EXPECT_EQ(window.marginalize(), test::ids<KeyframeId>({0}));
  EXPECT_TRUE(window.plane(FactorScene::kPlane)) << "its measurement is of keyframes 1 and 2";
  EXPECT_THROW(window.rescale(2), ArgumentError) << "it is a length";
}

TEST(WindowFactor, BetweenPlanesAloneHoldsNoneOfThemAndLeavesWithThem) {
  const FactorScene scene;
  SlidingWindow window = scene.window(exact_options(3));
  add_chain(window, scene);
  const Eigen::Matrix3d I = 1e4 * Eigen::Matrix3d::Identity();
  const Plane3 wall({1, -0.3, 0}, 2);
  window.add_plane(PlaneId(11), wall);
  add_plane_observation(window, {KeyframeId(0), FactorScene::kPlane,
                                 transform_to(scene.T_map_cam[0], scene.plane), I});
  add_plane_observation(window,
                        {KeyframeId(2), PlaneId(11), transform_to(scene.T_map_cam[2], wall), I});
  window.add({std::make_shared<PlaneOrthogonalFactor>(0.01),
              {plane_variable(FactorScene::kPlane), plane_variable(PlaneId(11))}});
  const Eigen::Matrix3d before = *plane_covariance(window, PlaneId(11), KeyframeId(3));
  window.marginalize();
  EXPECT_EQ(window.planes(), std::vector{PlaneId(11)});
  for (const WindowFactor& factor : window.factors())
    EXPECT_FALSE(touches(factor, plane_variable(FactorScene::kPlane)));
  EXPECT_LT((*plane_covariance(window, PlaneId(11), KeyframeId(3)) - before).norm(),
            1e-6 * before.norm())
      << "what it says of the plane that stays is in the prior";
}

TEST(WindowFactor, GoesWithThePlaneThatIsRemoved) {
  const FactorScene scene;
  SlidingWindow window = scene.window({});
  for (const auto& [name, factor] : factors_of_every_kind(scene)) window.add(factor);
  window.remove_plane(FactorScene::kPlane);
  EXPECT_EQ(window.factors().size(), 4u) << "a height, a measured plane and a step have gone";
}

TEST(WindowFactor, MustFitItsVariablesAndSayWhatItBecomesInAnotherFrame) {
  const FactorScene scene;
  SlidingWindow window = scene.window({});
  const auto distance = std::make_shared<DistanceFactor>(1, 0.1);
  const auto refusal = [&](const WindowFactor& factor) -> std::string {
    try {
      window.add(factor);
    } catch (const ArgumentError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(refusal({nullptr, {}}).find("no factor"), std::string::npos);
  EXPECT_NE(
      refusal({distance, {keyframe_variable(KeyframeId(0))}}).find("takes 2 variables, not 1"),
      std::string::npos);
  EXPECT_NE(
      refusal({distance, {keyframe_variable(KeyframeId(0)), plane_variable(FactorScene::kPlane)}})
          .find("another kind than plane 10"),
      std::string::npos);
  EXPECT_NE(
      refusal({distance, {keyframe_variable(KeyframeId(1)), keyframe_variable(KeyframeId(1))}})
          .find("keyframe 1 repeats"),
      std::string::npos);
  EXPECT_NE(
      refusal({distance, {keyframe_variable(KeyframeId(1)), keyframe_variable(KeyframeId(7))}})
          .find("keyframe 7 is not in the window"),
      std::string::npos);
  class Still final : public SizedFactor<1, SE3> {
    bool compute(const SE3&, Residual& r, Jacobians*) const override {
      r.setZero();
      return true;
    }
  };
  EXPECT_NE(refusal({std::make_shared<Still>(), {keyframe_variable(KeyframeId(1))}})
                .find("another frame"),
            std::string::npos);
  EXPECT_TRUE(window.factors().empty());
}

TEST(WindowFactor, OfFullRankAloneDeterminesAKeyframeWithoutLandmarks) {
  const FactorScene scene;
  for (const bool full : {true, false}) {
    SlidingWindow window({}, test::window_camera());
    window.add_keyframe(KeyframeId(0), scene.T_map_cam[0]);
    window.add_keyframe(KeyframeId(1), scene.T_map_cam[1]);
    Matrix6d information = motion_information();
    if (!full) information.row(2).setZero(), information.col(2).setZero();
    add_motion(window, {KeyframeId(0), KeyframeId(1),
                        scene.motion(0, 1).plus(Vector6d::Constant(0.01)), information});
    const WindowSummary summary = window.optimize();
    EXPECT_EQ(summary.outcome.code == Outcome::Code::kOk, full) << summary.outcome.reason;
    if (!full) {
      EXPECT_NE(summary.outcome.reason.find("keyframe 1 observes 0"), std::string::npos);
    }
  }
}

TEST(WindowFactor, OfOneKeyframeAndFullRankTakesThePlaceOfHoldingIt) {
  const FactorScene scene;
  SlidingWindow window = scene.window({});
  add_pose_prior(window, {KeyframeId(1), scene.T_map_cam[1], motion_information()});
  EXPECT_EQ(window.state().fixed, KeyframeId(0)) << "of another keyframe";
  Matrix6d rotation = Matrix6d::Zero();
  rotation.bottomRightCorner<3, 3>().setIdentity();
  add_pose_prior(window, {KeyframeId(0), scene.T_map_cam[0], rotation});
  EXPECT_EQ(window.state().fixed, KeyframeId(0)) << "of the rotation alone";
  add_pose_prior(window, {KeyframeId(0), scene.T_map_cam[0], motion_information()});
  EXPECT_FALSE(window.state().fixed);
}

TEST(WindowFactor, SaysWhetherItMeasuresTheUnitOfLength) {
  const FactorScene scene;
  for (const auto& [name, factor] : factors_of_every_kind(scene)) {
    SlidingWindow window = scene.window({});
    window.add(factor);
    const bool measures = name != "height" && name != "world";
    EXPECT_EQ(has_metric_observation(window.state()), measures) << name;
  }
  // One position in a map that nothing else holds says where the window lies, two give a length.
  SlidingWindow floating = scene.window({});
  add_pose_prior(floating, {KeyframeId(0), scene.T_map_cam[0], motion_information()});
  EXPECT_FALSE(has_metric_observation(floating.state()));
  add_pose_prior(floating, {KeyframeId(1), scene.T_map_cam[1], motion_information()});
  EXPECT_TRUE(has_metric_observation(floating.state()));
  // Two heights say nothing until three points hold the plane where they are.
  SlidingWindow window = scene.window({});
  window.add(factors_of_every_kind(scene)[1].second);
  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(has_metric_observation(window.state()));
    window.add_landmark(LandmarkId(i), Eigen::Vector3d(i, 0, 5));
    window.add_plane_point({FactorScene::kPlane, LandmarkId(i), 0.02});
  }
  EXPECT_TRUE(has_metric_observation(window.state()));
}

}  // namespace window_factor_test
}  // namespace placegraph
