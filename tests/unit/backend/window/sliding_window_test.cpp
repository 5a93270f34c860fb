#include <gtest/gtest.h>
#include <placegraph/backend/window/sliding_window.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Dense>

#include "tests/support/scenes/window_world.h"

namespace placegraph {
namespace sliding_window_test {

using test::angle_rad;
using test::distance_m;
using test::make_window_world;
using test::WindowWorld;
using test::WindowWorldOptions;

SlidingWindowOptions exact_options() {
  SlidingWindowOptions options;
  options.max_keyframes = 20;
  options.max_iterations = 100;
  options.relative_decrease = 1e-16;
  return options;
}

void expect_poses(const SlidingWindow& window, const WindowWorld& world, double tolerance_m,
                  double tolerance_rad) {
  for (const KeyframeId id : window.keyframes()) {
    const SE3& truth = world.T_map_cam[static_cast<std::size_t>(id.value())];
    EXPECT_LT(distance_m(window.pose(id), truth), tolerance_m) << "keyframe " << id;
    EXPECT_LT(angle_rad(window.pose(id), truth), tolerance_rad) << "keyframe " << id;
  }
}

TEST(SlidingWindow, RecoversAnExactMonoWindowFromOneDistance) {
  Random random(1);
  const WindowWorld world = make_window_world({}, random);
  SlidingWindow window(exact_options(), world.camera);
  fill_window(window, world, random, 0.05, 0.01, 0.3);
  add_distance(window, {KeyframeId(0), KeyframeId(5),
                        distance_m(world.T_map_cam[0], world.T_map_cam[5]), 0.01});
  const WindowSummary summary = window.optimize();
  ASSERT_TRUE(summary.outcome) << summary.outcome.reason;
  EXPECT_GT(summary.cost_initial, 100);
  EXPECT_LT(summary.cost_final, 1e-12);
  expect_poses(window, world, 1e-7, 1e-8);
  for (std::size_t i = 0; i < world.points.size(); ++i)
    EXPECT_LT((*window.landmark(LandmarkId(i)) - world.points[i]).norm(), 1e-5);
}

TEST(SlidingWindow, RecoversAnExactStereoWindow) {
  Random random(2);
  WindowWorldOptions options;
  options.stereo = true;
  const WindowWorld world = make_window_world(options, random);
  SlidingWindow window(exact_options(), world.camera);
  fill_window(window, world, random, 0.05, 0.01, 0.3);
  ASSERT_TRUE(window.optimize().outcome);
  expect_poses(window, world, 1e-7, 1e-8);
}

TEST(SlidingWindow, HoldsTheScaleItStartsFromWhereNothingMeasuresIt) {
  Random random(3);
  const WindowWorld world = make_window_world({}, random);
  SlidingWindow window(exact_options(), world.camera);
  fill_window(window, world, random, 0.05, 0.01, 0.3);
  const double length_m = distance_m(window.pose(KeyframeId(0)), window.pose(KeyframeId(7)));
  ASSERT_TRUE(window.optimize().outcome);
  EXPECT_NEAR(distance_m(window.pose(KeyframeId(0)), window.pose(KeyframeId(7))), length_m, 1e-9);
  const double scale = length_m / distance_m(world.T_map_cam[0], world.T_map_cam[7]);
  for (int k = 0; k < 8; ++k) {
    const Eigen::Vector3d expected =
        scale * world.T_map_cam[static_cast<std::size_t>(k)].translation();
    EXPECT_LT((window.pose(KeyframeId(k)).translation() - expected).norm(), 1e-7);
  }
}

TEST(SlidingWindow, RelativeInformationIsThatOfAllMeasurementsWithTheRestMarginalized) {
  Random random(4);
  WindowWorldOptions options;
  options.keyframes = 4;
  options.landmarks = 14;
  options.views_per_landmark = 4;
  options.stereo = true;
  const WindowWorld world = make_window_world(options, random);
  SlidingWindow window(exact_options(), world.camera);
  fill_window(window, world, random, 0, 0, 0);
  // The same by finite differences of all residuals, without the library's factors.
  const auto residuals = [&](const Eigen::VectorXd& x) {
    Eigen::VectorXd r(3 * static_cast<Eigen::Index>(world.observations.size()));
    for (std::size_t i = 0; i < world.observations.size(); ++i) {
      const WindowObservation& o = world.observations[i];
      const SE3 T_map_cam = world.T_map_cam[static_cast<std::size_t>(o.keyframe.value())] *
                            SE3::exp(x.segment<6>(6 * o.keyframe.value()));
      const Eigen::Vector3d p =
          T_map_cam.inverse() * (world.points[static_cast<std::size_t>(o.landmark.value())] +
                                 x.segment<3>(24 + 3 * o.landmark.value()));
      r.segment<2>(3 * static_cast<Eigen::Index>(i)) =
          (*world.camera.project(p) - o.px) / o.sigma_px;
      r[3 * static_cast<Eigen::Index>(i) + 2] =
          (1 / p[2] - *o.inverse_depth) / o.sigma_inverse_depth;
    }
    return r;
  };
  const Eigen::Index n = 24 + 3 * 14;
  Eigen::MatrixXd J(3 * static_cast<Eigen::Index>(world.observations.size()), n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const Eigen::VectorXd step = Eigen::VectorXd::Unit(n, j) * 1e-5;
    J.col(j) = (residuals(step) - residuals(-step)) / 2e-5;
  }
  for (const auto& [from, to] : {std::pair{1, 3}, {3, 0}}) {
    // `from` held: its columns go; what is left is regular.
    std::vector<Eigen::Index> columns;
    for (int i = 0; i < 6; ++i) columns.push_back(6 * to + i);
    for (Eigen::Index j = 0; j < n; ++j)
      if (j / 6 != from && j / 6 != to) columns.push_back(j);
    const Eigen::MatrixXd J_free = J(Eigen::all, columns);
    const Eigen::MatrixXd covariance = (J_free.transpose() * J_free).inverse();
    const Matrix6d expected = covariance.topLeftCorner<6, 6>().inverse();
    const Matrix6d information = relative_information(window, KeyframeId(from), KeyframeId(to));
    EXPECT_LT((information - expected).norm(), 1e-5 * expected.norm()) << from << " " << to;
    EXPECT_LT((information * covariance.topLeftCorner<6, 6>() - Matrix6d::Identity()).norm(), 1e-3);
  }
}

TEST(SlidingWindow, RelativeInformationLacksTheScaleOfAMonoWindowUntilADistanceGivesIt) {
  Random random(5);
  const WindowWorld world = make_window_world({}, random);
  SlidingWindow window(exact_options(), world.camera);
  fill_window(window, world, random, 0, 0, 0);
  const SE3 T_2_6 = world.T_map_cam[2].inverse() * world.T_map_cam[6];
  // Right tangent of a change of scale: the translation grows, the rotation does not.
  Vector6d scaling = Vector6d::Zero();
  scaling.head<3>() = T_2_6.rotation().inverse() * T_2_6.translation();
  const Matrix6d without = relative_information(window, KeyframeId(2), KeyframeId(6));
  Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(without);
  EXPECT_GE(eigen.eigenvalues()[0], -1e-6 * eigen.eigenvalues()[5]);
  EXPECT_GT(eigen.eigenvalues()[1], 1.0);
  EXPECT_LT(scaling.dot(without * scaling), 1e-6 * scaling.squaredNorm() * eigen.eigenvalues()[1]);
  const double sigma_m = 0.02, length_m = T_2_6.translation().norm();
  add_distance(window, {KeyframeId(2), KeyframeId(6), length_m, sigma_m});
  const Matrix6d with = relative_information(window, KeyframeId(2), KeyframeId(6));
  EXPECT_NEAR(scaling.dot(with * scaling), length_m * length_m / (sigma_m * sigma_m), 1e-2);
}

TEST(SlidingWindow, ErrorsAgreeWithTheRelativeInformation) {
  const int runs = 30;
  double nees = 0;
  for (int run = 0; run < runs; ++run) {
    Random random(100 + static_cast<std::uint64_t>(run));
    WindowWorldOptions options;
    options.keyframes = 6;
    options.landmarks = 40;
    options.stereo = true;
    options.noise_px = options.sigma_px = 0.5;
    const WindowWorld world = make_window_world(options, random);
    SlidingWindowOptions window_options = exact_options();
    window_options.huber_px = 100;  // the noise is normal
    window_options.relative_decrease = 1e-9;
    SlidingWindow window(window_options, world.camera);
    fill_window(window, world, random, 0.02, 0.002, 0.1);
    ASSERT_TRUE(window.optimize().outcome);
    const SE3 truth = world.T_map_cam[1].inverse() * world.T_map_cam[5];
    const SE3 estimate = window.pose(KeyframeId(1)).inverse() * window.pose(KeyframeId(5));
    const Vector6d error = (estimate.inverse() * truth).log();
    nees += error.dot(relative_information(window, KeyframeId(1), KeyframeId(5)) * error) / runs;
  }
  // Mean of 30 chi2 of 6 degrees: standard deviation sqrt(12 / 30) = 0.63; 3.5 of them.
  EXPECT_NEAR(nees, 6, 2.2) << "seeds 100 to 129";
}

TEST(SlidingWindow, TellsHowWellItHoldsItsUnitWhateverTheGauge) {
  const int runs = 30;
  double nees = 0;
  for (int run = 0; run < runs; ++run) {
    Random random(200 + static_cast<std::uint64_t>(run));
    WindowWorldOptions options;
    options.keyframes = 7;
    options.landmarks = 60;
    options.views_per_landmark = 4;
    options.noise_px = options.sigma_px = 0.5;
    const WindowWorld world = make_window_world(options, random);
    SlidingWindowOptions window_options = exact_options();
    window_options.huber_px = 100;  // the noise is normal
    window_options.relative_decrease = 1e-9;
    SlidingWindow window(window_options, world.camera);
    fill_window(window, world, random, 0.02, 0.002, 0.1);
    ASSERT_TRUE(window.optimize().outcome);
    const auto log_ratio = [](const SE3& a, const SE3& b, const SE3& c) {
      return std::log(distance_m(b, c) / distance_m(a, b));
    };
    const auto& truth = world.T_map_cam;
    const double error = log_ratio(window.pose(KeyframeId(0)), window.pose(KeyframeId(3)),
                                   window.pose(KeyframeId(6))) -
                         log_ratio(truth[0], truth[3], truth[6]);
    const double sigma =
        sigma_log_length_ratio(window, KeyframeId(0), KeyframeId(3), KeyframeId(6));
    nees += error * error / (sigma * sigma * runs);
    if (run > 0) continue;
    // A length that is known makes the unit the metre, not the unit's change smaller.
    add_distance(window,
                 {KeyframeId(0), KeyframeId(6),
                  distance_m(window.pose(KeyframeId(0)), window.pose(KeyframeId(6))), 0.01});
    EXPECT_NEAR(sigma_log_length_ratio(window, KeyframeId(0), KeyframeId(3), KeyframeId(6)), sigma,
                0.02 * sigma);
    EXPECT_THROW((void)sigma_log_length_ratio(window, KeyframeId(0), KeyframeId(3), KeyframeId(3)),
                 ArgumentError);
    EXPECT_THROW((void)sigma_log_length_ratio(window, KeyframeId(0), KeyframeId(3), KeyframeId(9)),
                 ArgumentError);
  }
  // Mean of 30 chi2 of one degree: standard deviation sqrt(2 / 30) = 0.26; 3.5 of them.
  EXPECT_NEAR(nees, 1, 0.9) << "seeds 200 to 229";
}

TEST(SlidingWindow, HuberSuppressesOutliers) {
  const auto worst_error_m = [](double huber_px) {
    Random random(6);
    WindowWorldOptions options;
    options.stereo = true;
    options.noise_px = options.sigma_px = 0.5;
    WindowWorld world = make_window_world(options, random);
    for (WindowObservation& o : world.observations)
      if (random.index(10) == 0) o.px += Eigen::Vector2d(40, 25);
    SlidingWindowOptions window_options = exact_options();
    window_options.huber_px = huber_px;
    SlidingWindow window(window_options, world.camera);
    fill_window(window, world, random, 0.02, 0.002, 0.1);
    EXPECT_TRUE(window.optimize().outcome);
    double worst = 0;
    for (int k = 0; k < options.keyframes; ++k)
      worst = std::max(worst, distance_m(window.pose(KeyframeId(k)),
                                         world.T_map_cam[static_cast<std::size_t>(k)]));
    return worst;
  };
  // An outlier pulls like two sigmas, all of them to one side: 0.1 of the points by 1 px, about
  // 0.1 px of bias in all, 1.4e-4 rad, which over points at 6 to 30 m is centimetres at most.
  EXPECT_LT(worst_error_m(2), 0.1);
  EXPECT_GT(worst_error_m(1e6), 0.3);
}

TEST(SlidingWindow, RemovedObservationsAndLandmarksNoLongerCount) {
  Random random(7);
  WindowWorldOptions options;
  options.stereo = true;
  WindowWorld world = make_window_world(options, random);
  world.observations[0].px += Eigen::Vector2d(30, 0);  // landmark 0, keyframe 0
  SlidingWindow window(exact_options(), world.camera);
  fill_window(window, world, random, 0.02, 0.002, 0.1);
  window.add_landmark(LandmarkId(1000), world.points[0]);
  for (int k = 0; k < 3; ++k) {
    WindowObservation wrong = world.observations[static_cast<std::size_t>(k)];
    wrong.landmark = LandmarkId(1000);
    wrong.px += Eigen::Vector2d(50 * k, 20);
    window.add_observation(wrong);
  }
  window.remove_observation(KeyframeId(0), LandmarkId(0));
  window.remove_landmark(LandmarkId(1000));
  EXPECT_EQ(window.observations(LandmarkId(0)).front().keyframe, KeyframeId(1));
  EXPECT_FALSE(window.landmark(LandmarkId(1000)));
  ASSERT_TRUE(window.optimize().outcome);
  expect_poses(window, world, 1e-7, 1e-8);
}

TEST(SlidingWindow, ARevisedInverseDepthTakesTheMeasuredOnesPlace) {
  Random random(7);
  WindowWorldOptions options;
  options.stereo = true;
  const WindowWorld world = make_window_world(options, random);
  WindowWorld biased = world;  // by a tenth of a pixel of 0.5 m
  for (WindowObservation& o : biased.observations) *o.inverse_depth += 0.1 / (718 * 0.5);
  SlidingWindow window(exact_options(), world.camera);
  fill_window(window, biased, random, 0.02, 0.002, 0.1);
  const Matrix6d before = relative_information(window, KeyframeId(0), KeyframeId(1));
  for (const WindowObservation& o : world.observations)
    window.revise_inverse_depth(o.keyframe, o.landmark, *o.inverse_depth);
  ASSERT_TRUE(window.optimize().outcome);
  expect_poses(window, world, 1e-7, 1e-8);
  EXPECT_NE(relative_information(window, KeyframeId(0), KeyframeId(1)),
            before);  // of the new state, not the old one's
  EXPECT_THROW(window.revise_inverse_depth(KeyframeId(0), LandmarkId(0), std::nan("")),
               ArgumentError);
  EXPECT_THROW(window.revise_inverse_depth(KeyframeId(99), LandmarkId(0), 0.1), ArgumentError);
  EXPECT_THROW(window.revise_inverse_depth(KeyframeId(0), LandmarkId(9999), 0.1), ArgumentError);
}

TEST(SlidingWindow, APointSeenOnceMovesWithItsKeyframe) {
  Random random(8);
  WindowWorldOptions options;
  options.stereo = true;
  const WindowWorld world = make_window_world(options, random);
  SlidingWindow window(exact_options(), world.camera);
  fill_window(window, world, random, 0.05, 0.01, 0.1);
  const Eigen::Vector3d p_cam(1, 0.5, 12);
  window.add_landmark(LandmarkId(500), window.pose(KeyframeId(4)) * p_cam);
  window.add_observation({KeyframeId(4), LandmarkId(500), *world.camera.project(p_cam), 1, {}, 1});
  ASSERT_TRUE(window.optimize().outcome);
  EXPECT_LT((*window.landmark(LandmarkId(500)) - window.pose(KeyframeId(4)) * p_cam).norm(), 1e-9);
}

TEST(SlidingWindow, APointBehindItsCamerasDisturbsNothing) {
  Random random(9);
  WindowWorldOptions options;
  options.stereo = true;
  const WindowWorld world = make_window_world(options, random);
  SlidingWindow window(exact_options(), world.camera);
  fill_window(window, world, random, 0.05, 0.01, 0.1);
  window.add_landmark(LandmarkId(500), {0, 0, -40});
  window.add_landmark(LandmarkId(501), world.T_map_cam[3].translation());  // in a camera's centre
  for (const std::int64_t landmark : {500, 501})
    for (const std::int64_t k : {2, 3, 4})
      window.add_observation(
          {KeyframeId(k), LandmarkId(landmark), Eigen::Vector2d(600, 180), 1, {}, 1});
  ASSERT_TRUE(window.optimize().outcome);
  expect_poses(window, world, 0.05, 0.005);
  EXPECT_FALSE(residual_px(window, window.observations(LandmarkId(500)).front()));
  EXPECT_TRUE(window.landmark(LandmarkId(500))->allFinite());
  EXPECT_TRUE(window.landmark(LandmarkId(501))->allFinite());
  EXPECT_TRUE(relative_information(window, KeyframeId(2), KeyframeId(4)).allFinite());
}

TEST(SlidingWindow, TellsWhenTheDataAreTooFew) {
  SlidingWindow window({}, test::window_camera());
  EXPECT_EQ(window.optimize().outcome.code, Outcome::Code::kTooFewData);
  window.add_keyframe(KeyframeId(0), SE3());
  EXPECT_EQ(window.optimize().outcome.code, Outcome::Code::kTooFewData);
  const SE3 T_map_cam(SO3(), Eigen::Vector3d(0, 0, 1));
  window.add_keyframe(KeyframeId(1), T_map_cam);
  window.add_landmark(LandmarkId(7), {0, 0, 10});
  window.add_observation({KeyframeId(0), LandmarkId(7), {600, 180}, 1, {}, 1});
  window.add_observation({KeyframeId(1), LandmarkId(7), {600, 180}, 1, {}, 1});
  const WindowSummary summary = window.optimize();
  EXPECT_EQ(summary.outcome.code, Outcome::Code::kTooFewData);
  EXPECT_NE(summary.outcome.reason.find("keyframe 1 observes 1"), std::string::npos);
  EXPECT_EQ(distance_m(window.pose(KeyframeId(1)), T_map_cam), 0);
  EXPECT_TRUE(relative_information(window, KeyframeId(0), KeyframeId(1)).allFinite());
}

TEST(SlidingWindow, CoincidentKeyframesGiveFiniteResults) {
  Random random(10);
  WindowWorldOptions options;
  options.step_m = 0;  // mono, rotation only: depth is not observable
  options.noise_px = 0.5;
  const WindowWorld world = make_window_world(options, random);
  SlidingWindow window({}, world.camera);
  fill_window(window, world, random, 0, 0.001, 0);
  EXPECT_NE(window.optimize().outcome.code, Outcome::Code::kNotAttempted);
  for (const KeyframeId id : window.keyframes()) EXPECT_TRUE(window.pose(id).matrix().allFinite());
  for (const LandmarkId id : window.landmarks()) EXPECT_TRUE(window.landmark(id)->allFinite());
  EXPECT_TRUE(relative_information(window, KeyframeId(0), KeyframeId(7)).allFinite());
}

TEST(SlidingWindow, ResidualIsTheReprojectionErrorInPixels) {
  SlidingWindow window({}, test::window_camera());
  window.add_keyframe(KeyframeId(3), SE3());
  window.add_landmark(LandmarkId(9), {1, 0.5, 10});
  WindowObservation o{KeyframeId(3), LandmarkId(9), {0, 0}, 2, {}, 1};
  o.px = *test::window_camera().project({1, 0.5, 10}) - Eigen::Vector2d(3, -4);
  window.add_observation(o);
  EXPECT_LT((*residual_px(window, o) - Eigen::Vector2d(3, -4)).norm(), 1e-10);
  o.landmark = LandmarkId(10);
  EXPECT_FALSE(residual_px(window, o));
}

TEST(SlidingWindow, RefusesWhatItsContractExcludes) {
  SlidingWindowOptions bad;
  bad.max_keyframes = 1;
  EXPECT_THROW(SlidingWindow(bad, test::window_camera()), ArgumentError);
  Camera distorted = test::window_camera();
  distorted.distortion = Distortion::kRadialTangential;
  EXPECT_THROW(SlidingWindow({}, distorted), ArgumentError);

  SlidingWindow window({}, test::window_camera());
  window.add_keyframe(KeyframeId(5), SE3());
  window.add_keyframe(KeyframeId(6), SE3());
  window.add_landmark(LandmarkId(1), {0, 0, 5});
  window.add_observation({KeyframeId(5), LandmarkId(1), {600, 180}, 1, {}, 1});
  const double nan = std::nan("");
  EXPECT_THROW(window.add_keyframe(KeyframeId(6), SE3()), ArgumentError);
  EXPECT_THROW(window.add_keyframe(KeyframeId(7), SE3(SO3(), Eigen::Vector3d(nan, 0, 0))),
               ArgumentError);
  EXPECT_THROW(window.add_landmark(LandmarkId(1), {0, 0, 5}), ArgumentError);
  EXPECT_THROW(window.add_landmark(LandmarkId(2), {0, nan, 5}), ArgumentError);
  EXPECT_THROW(window.add_observation({KeyframeId(5), LandmarkId(1), {600, 180}, 1, {}, 1}),
               ArgumentError);
  EXPECT_THROW(window.add_observation({KeyframeId(4), LandmarkId(1), {600, 180}, 1, {}, 1}),
               ArgumentError);
  EXPECT_THROW(window.add_observation({KeyframeId(6), LandmarkId(2), {600, 180}, 1, {}, 1}),
               ArgumentError);
  EXPECT_THROW(window.add_observation({KeyframeId(6), LandmarkId(1), {600, nan}, 1, {}, 1}),
               ArgumentError);
  EXPECT_THROW(window.add_observation({KeyframeId(6), LandmarkId(1), {600, 180}, 0, {}, 1}),
               ArgumentError);
  EXPECT_THROW(window.add_observation({KeyframeId(6), LandmarkId(1), {600, 180}, 1, nan, 1}),
               ArgumentError);
  EXPECT_THROW(window.add_observation(
                   {KeyframeId(6), LandmarkId(1), {600, 180}, 1, {}, 1, Eigen::Matrix2d::Ones()}),
               ArgumentError);
  EXPECT_THROW(add_distance(window, {KeyframeId(5), KeyframeId(5), 1, 1}), ArgumentError);
  EXPECT_THROW(add_distance(window, {KeyframeId(5), KeyframeId(6), -1, 1}), ArgumentError);
  EXPECT_THROW(add_distance(window, {KeyframeId(5), KeyframeId(7), 1, 1}), ArgumentError);
  EXPECT_THROW(window.remove_landmark(LandmarkId(2)), ArgumentError);
  EXPECT_THROW(window.remove_observation(KeyframeId(6), LandmarkId(1)), ArgumentError);
  EXPECT_THROW(window.pose(KeyframeId(4)), ArgumentError);
  EXPECT_THROW(window.observations(LandmarkId(4)), ArgumentError);
  EXPECT_THROW((void)relative_information(window, KeyframeId(5), KeyframeId(5)), ArgumentError);
}

}  // namespace sliding_window_test
}  // namespace placegraph
