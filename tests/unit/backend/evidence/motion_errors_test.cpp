#include <gtest/gtest.h>
#include <placegraph/backend/evidence/motion_errors.h>
#include <placegraph/backend/window/sliding_window.h>
#include <placegraph/backend/window/window_state.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>

#include <Eigen/Cholesky>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace placegraph {
namespace motion_errors_test {

using E = ImagingErrors;

constexpr double kStep_s = 0.2, kSigma_px = 0.5, kSigmaInverseDepth = 0.002;

Camera assumed_camera() {
  Camera camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = 500;
  camera.fy = 510;
  camera.cx = 322;
  camera.cy = 238;
  return camera;
}

/// A camera that moves through a room, seven keyframes with measured depths.
std::vector<SE3> walk() {
  std::vector<SE3> T_map_cam;
  for (int k = 0; k < 7; ++k)
    T_map_cam.emplace_back(SO3::exp({0.02 * (k % 3), 0.05 * k, 0.01 * (k % 2)}),
                           Eigen::Vector3d(0.03 * (k % 2), 0.02 * (k % 3), 0.15 * k));
  return T_map_cam;
}

/// Errors of one observation: of the pixel and the inverse depth.
using Noise = std::function<Eigen::Vector3d(int landmark, int keyframe)>;

/// The window of the walk, whose images have the errors `q` and the noise; optimized.
SlidingWindow window_of(const E::Vector& q, bool disparities, const Noise& noise) {
  SlidingWindowOptions options;
  options.max_keyframes = 100;
  options.max_iterations = 100;
  options.relative_decrease = 1e-14;
  options.depths_from_disparities = disparities;
  const Camera camera = assumed_camera();
  const std::vector<SE3> T_map_cam = walk();
  SlidingWindow window(options, camera);
  for (int k = 0; k < 7; ++k)
    window.add_keyframe(KeyframeId(k), T_map_cam[static_cast<std::size_t>(k)], kStep_s * k);
  Random random(5);
  for (int i = 0; i < 200; ++i) {
    const double z = random.uniform(2, 6);
    const Eigen::Vector3d p_map(z * random.uniform(-0.5, 0.8), z * random.uniform(-0.4, 0.4), z);
    bool added = false;
    for (int k = 0; k < 7; ++k) {
      const Eigen::Vector3d p_cam = T_map_cam[static_cast<std::size_t>(k)].inverse() * p_map;
      const auto px = p_cam.z() > 0.5 ? camera.project(p_cam) : std::nullopt;
      if (!px || !camera.contains(*px)) continue;
      const auto velocity = velocity_of(window.state(), KeyframeId(k));
      const Eigen::Vector3d error =
          derivative_by_imaging_errors(camera, p_cam, velocity, disparities) * q + noise(i, k);
      if (!added) window.add_landmark(LandmarkId(i), p_map);
      added = true;
      WindowObservation o;
      o.keyframe = KeyframeId(k);
      o.landmark = LandmarkId(i);
      o.px = *px + error.head<2>();
      o.sigma_px = kSigma_px;
      o.inverse_depth = 1 / p_cam.z() + error.z();
      o.sigma_inverse_depth = kSigmaInverseDepth;
      window.add_observation(o);
    }
  }
  EXPECT_TRUE(window.optimize().outcome);
  return window;
}

Eigen::Vector3d none(int /*landmark*/, int /*keyframe*/) { return Eigen::Vector3d::Zero(); }

constexpr KeyframeId kFrom(1), kTo(5);

Vector6d error_of_motion(const SlidingWindow& window) {
  const std::vector<SE3> T = walk();
  const SE3 truth = T[1].inverse() * T[5];
  return (truth.inverse() * window.pose(kFrom).inverse() * window.pose(kTo)).log();
}

Noise white(double share, std::uint64_t seed) {
  auto random = std::make_shared<Random>(seed);
  return [=](int, int) {
    return Eigen::Vector3d(share * kSigma_px * random->normal(),
                           share * kSigma_px * random->normal(),
                           share * kSigmaInverseDepth * random->normal());
  };
}

TEST(ImagingErrors, TheDerivativeIsThatOfTheModel) {
  const Camera camera = assumed_camera();
  const Eigen::Vector3d p(0.7, -0.4, 2.5);
  Vector6d velocity;
  velocity << 0.3, -0.2, 1.5, 0.1, 0.5, -0.3;
  const double inverse_depth = 1 / p.z(), f = 1.01, a = 0.004;
  const auto J = derivative_by_imaging_errors(camera, p, velocity, true);
  const Eigen::Vector2d px = *camera.project(p);
  EXPECT_NEAR(J(0, E::kFocal), px[0] - camera.cx, 1e-9);
  EXPECT_NEAR(J(2, E::kFocal), inverse_depth, 1e-12);
  EXPECT_EQ(derivative_by_imaging_errors(camera, p, velocity, false)(2, E::kFocal), 0);
  EXPECT_NEAR(a * J(1, E::kAspect), -0.5 * a * (px[1] - camera.cy), 1e-9);
  EXPECT_NEAR((f - 1) * J(0, E::kPrincipalX), (f - 1) * camera.fx, 1e-9);
  Camera bent = camera;
  bent.distortion = Distortion::kRadialTangential;
  bent.coefficients = {1e-5};
  EXPECT_LT((1e-5 * J.col(E::kRadial).head<2>() - (*bent.project(p) - px)).norm(), 1e-6);
  // The row is exposed later: the point has moved on in the camera.
  const double late_s = 1e-4 * (px[1] / (camera.height - 1) - 0.5);
  const Eigen::Vector3d moved = SE3::exp(-late_s * velocity) * p;
  EXPECT_LT((1e-4 * J.col(E::kReadout).head<2>() - (*camera.project(moved) - px)).norm(), 1e-5);
  EXPECT_NEAR(1e-4 * J(2, E::kReadout), 1 / moved.z() - inverse_depth, 1e-8);
  EXPECT_EQ(derivative_by_imaging_errors(camera, p, std::nullopt, true).col(E::kReadout).norm(), 0);
}

TEST(MotionErrors, ImagingErrorsMoveTheEstimateAsTheirDerivativeSays) {
  for (const bool disparities : {true, false}) {
    for (Eigen::Index i = 0; i < E::kParameters; ++i) {
      E::Vector q = E::Vector::Zero();
      q[i] = i == E::kReadout ? 2e-3 : i == E::kInverseDepth ? 1e-3 : 2e-3;
      const SlidingWindow window = window_of(q, disparities, none);
      const Vector6d moved = error_of_motion(window);
      const Vector6d expected = motion_errors(window, kFrom, kTo).by_imaging_errors * q;
      EXPECT_LT((moved - expected).norm(), 0.05 * moved.norm() + 1e-6)
          << "parameter " << i << ": " << moved.transpose() << " | " << expected.transpose();
    }
  }
}

TEST(MotionErrors, WhiteNoiseAsStatedScattersAsStated) {
  Vector6d ratio = Vector6d::Zero();
  constexpr int kRuns = 8;
  for (int run = 0; run < kRuns; ++run) {
    const auto errors = motion_errors(
        window_of(E::Vector::Zero(), true, white(1, static_cast<std::uint64_t>(run) + 1)), kFrom,
        kTo);
    ratio += errors.scatter.diagonal().cwiseQuotient(errors.stated.diagonal()) / kRuns;
  }
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(ratio[i], 1, 0.3) << i;
}

TEST(MotionErrors, HalfOfTheNoiseScattersAQuarterAndErrorsAlongTracksMore) {
  const auto half = motion_errors(window_of(E::Vector::Zero(), true, white(0.5, 3)), kFrom, kTo);
  const double quarter =
      half.scatter.diagonal().cwiseQuotient(half.stated.diagonal()).mean();
  EXPECT_NEAR(quarter, 0.25, 0.1);
  // Each track drifts away from its point, as a patch that is warped does.
  Random random(4);
  std::vector<Eigen::Vector2d> drift;
  for (int i = 0; i < 200; ++i) drift.emplace_back(0.3 * random.normal(), 0.3 * random.normal());
  const Noise noise = white(0.5, 3);
  const auto correlated = motion_errors(
      window_of(E::Vector::Zero(), true,
                [&](int i, int k) -> Eigen::Vector3d {
                  Eigen::Vector3d error = noise(i, k);
                  error.head<2>() += k * drift[static_cast<std::size_t>(i)];
                  return error;
                }),
      kFrom, kTo);
  EXPECT_GT(correlated.scatter.diagonal().cwiseQuotient(correlated.stated.diagonal()).mean(),
            4 * quarter);
}

TEST(MotionErrors, RescalingGivesTheScatterAndKeepsAFloor) {
  const SlidingWindow window = window_of(E::Vector::Zero(), true, white(1.5, 7));
  const MotionErrors errors = motion_errors(window, kFrom, kTo);
  const Matrix6d same = rescaled_by_scatter(errors.stated, errors, 0);
  // A hundredth of the covariance stands for what the images leave open.
  EXPECT_LT((same - errors.scatter).norm(), 0.05 * errors.scatter.norm());
  MotionErrors certain = errors;
  certain.scatter.setZero();
  const Matrix6d floor = rescaled_by_scatter(errors.stated, certain, 0.25);
  EXPECT_LT((floor - 0.25 * errors.stated).norm(), 1e-6 * errors.stated.norm());
}

TEST(MotionErrors, TheEvidenceFindsTheErrorsOfTheImages) {
  for (const auto parameter : {E::kFocal, E::kPrincipalX, E::kPrincipalY, E::kReadout}) {
    E::Vector q = E::Vector::Zero();
    q[parameter] = 0.004;
    const NuisanceEvidence evidence = imaging_evidence(window_of(q, true, none));
    E::Matrix I = evidence.information;
    I.diagonal().array() += 1e-9 * I.diagonal().maxCoeff();
    const E::Vector found = -I.ldlt().solve(evidence.gradient);
    EXPECT_NEAR(found[parameter], 0.004, 4e-4) << parameter;
  }
}

TEST(MotionErrors, AMotionNeedsTwoKeyframesOfTheWindow) {
  const SlidingWindow window = window_of(E::Vector::Zero(), true, none);
  EXPECT_THROW(motion_errors(window, kFrom, kFrom), ArgumentError);
  EXPECT_THROW(motion_errors(window, kFrom, KeyframeId(9)), ArgumentError);
}

}  // namespace motion_errors_test
}  // namespace placegraph
