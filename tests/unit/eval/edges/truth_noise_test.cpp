#include <gtest/gtest.h>
#include <placegraph/eval/edges/truth_noise.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/random.h>

#include <cmath>

namespace placegraph {
namespace truth_noise_test {

Trajectory trajectory_of(const std::vector<SE3>& poses) {
  Trajectory result;
  result.has_times = false;
  for (std::size_t i = 0; i < poses.size(); ++i)
    result.poses.push_back({static_cast<std::int64_t>(i), poses[i].isometry()});
  return result;
}

/// A camera in a hand: smooth motion in all directions.
std::vector<SE3> hand_held(int frames) {
  std::vector<SE3> poses;
  for (int i = 0; i < frames; ++i) {
    const double s = 0.05 * i;
    poses.emplace_back(SO3::exp({0.4 * std::sin(s), 0.7 * std::sin(0.6 * s), 0.2 * std::cos(s)}),
                       Eigen::Vector3d(std::sin(0.8 * s), 0.3 * std::cos(1.1 * s), 0.4 * s));
  }
  return poses;
}

/// A car that drives 0.8 m a frame; its camera, 1 m ahead of the rear axle, looks along it.
std::vector<SE3> drive(int frames) {
  std::vector<SE3> poses;
  const SE3 T_axle_cam(SO3(), Eigen::Vector3d(0, 0, 1));
  SE3 T_world_axle;
  for (int i = 0; i < frames; ++i) {
    poses.push_back(T_world_axle * T_axle_cam);
    Vector6d step = Vector6d::Zero();
    step[2] = 0.8;
    step[4] = 0.03 * std::sin(0.02 * i);
    T_world_axle = T_world_axle * SE3::exp(step);
  }
  return poses;
}

void add_noise(const Vector6d& sigma, std::vector<SE3>& poses) {
  Random random(3);
  for (SE3& pose : poses) {
    Vector6d noise;
    for (int k = 0; k < 6; ++k) noise[k] = random.normal(0, sigma[k]);
    pose = pose.plus(noise);
  }
}

const Vector6d kSigma = (Vector6d() << 0.002, 0.001, 0.003, 0.001, 0.0005, 0.002).finished();

TEST(TruthNoise, IsFoundInSmoothMotion) {
  for (std::vector<SE3> poses : {hand_held(1000), drive(1000)}) {
    add_noise(kSigma, poses);
    const TruthNoise noise = estimate_truth_noise(trajectory_of(poses));
    ASSERT_TRUE(noise.outcome);
    for (int k = 0; k < 6; ++k) EXPECT_NEAR(noise.sigma[k], kSigma[k], 0.2 * kSigma[k]) << k;
    EXPECT_TRUE(noise.interpolated.empty());
  }
}

TEST(TruthNoise, OfExactPosesIsNone) {
  for (const std::vector<SE3>& poses : {hand_held(400), drive(400)}) {
    const TruthNoise noise = estimate_truth_noise(trajectory_of(poses));
    EXPECT_LT(noise.sigma.maxCoeff(), 5e-5);
    EXPECT_TRUE(noise.interpolated.empty());
  }
}

TEST(TruthNoise, IsNotLessWhereTheCameraShakesForAPart) {
  std::vector<SE3> poses = hand_held(1000);
  Random random(5);
  for (int i = 0; i < 500; ++i)
    poses[i] = poses[i] * SE3(SO3(), 0.05 * Eigen::Vector3d(random.normal(), random.normal(), 0));
  add_noise(kSigma, poses);
  const TruthNoise noise = estimate_truth_noise(trajectory_of(poses));
  for (int k = 0; k < 3; ++k) {
    EXPECT_GT(noise.sigma[k], 0.8 * kSigma[k]) << k;
    EXPECT_LT(noise.sigma[k], 2 * kSigma[k]) << k;
  }
}

TEST(TruthNoise, FindsInterpolatedPoses) {
  std::vector<SE3> poses = drive(400);
  add_noise(kSigma, poses);
  const SE3 step = SE3::exp((poses[200].inverse() * poses[220]).log() / 20);
  for (int i = 201; i < 220; ++i) poses[i] = poses[i - 1] * step;
  const TruthNoise noise = estimate_truth_noise(trajectory_of(poses));
  ASSERT_EQ(noise.interpolated.size(), 1u);
  EXPECT_EQ(noise.interpolated[0].first, 200);
  EXPECT_EQ(noise.interpolated[0].last, 220);
  EXPECT_FALSE(noise.is_interpolated(199));
  EXPECT_TRUE(noise.is_interpolated(210));
}

TEST(TruthNoise, TakesNeitherStandingNorExactMotionForInterpolation) {
  std::vector<SE3> standing = drive(400);
  add_noise(kSigma, standing);
  for (int i = 100; i < 160; ++i) standing[i] = standing[99];
  for (int i = 160; i < 400; ++i) standing[i] = standing[i - 60];  // no jump behind it
  EXPECT_TRUE(estimate_truth_noise(trajectory_of(standing)).interpolated.empty());
  std::vector<SE3> lines;  // straight lines joined by arcs, and turns that begin gently
  SE3 T;
  for (int i = 0; i < 400; ++i) {
    lines.push_back(T);
    Vector6d step = Vector6d::Zero();
    step[2] = 0.5;
    step[4] = i % 100 < 40 ? 0 : 0.02 * std::sin(0.1 * (i % 100 - 40));
    T = T * SE3::exp(step);
  }
  EXPECT_TRUE(estimate_truth_noise(trajectory_of(lines)).interpolated.empty());
}

TEST(TruthNoise, OfAVehiclesHeadingIsItsAngleToTheMotion) {
  std::vector<SE3> poses = drive(2000);
  Random random(7);
  double heading = 0;
  const double kept = 0.99, sigma = deg_to_rad(0.5);
  for (SE3& pose : poses) {
    heading = kept * heading + std::sqrt(1 - kept * kept) * random.normal(0, sigma);
    pose = pose * SE3(SO3::exp({0, heading, 0}), Eigen::Vector3d::Zero());
  }
  const TruthNoise noise = estimate_truth_noise(trajectory_of(poses));
  ASSERT_FALSE(noise.direction.empty());
  EXPECT_NEAR(noise.direction.front().lateral_rad, sigma, 0.3 * sigma);
  EXPECT_LT(noise.direction.front().vertical_rad, 0.05 * sigma);
  EXPECT_LT(noise.direction.back().lateral_rad, noise.direction.front().lateral_rad);
}

TEST(TruthNoise, OfTheDirectionIsThatOfVehiclesAlone) {
  EXPECT_FALSE(estimate_truth_noise(trajectory_of(drive(300))).direction.empty());
  EXPECT_TRUE(estimate_truth_noise(trajectory_of(drive(24))).direction.empty());  // 19 m
  EXPECT_TRUE(estimate_truth_noise(trajectory_of(hand_held(2000))).direction.empty());
}

TEST(TruthNoise, GivesTheCovarianceOfARelativePose) {
  TruthNoise noise;
  noise.sigma = kSigma;
  const SE3 T_from_to(SO3::exp({0.1, 0.4, -0.2}), Eigen::Vector3d(0.5, 0.1, 2));
  Random random(9);
  Matrix6d found = Matrix6d::Zero();
  constexpr int kDraws = 20000;
  for (int i = 0; i < kDraws; ++i) {
    std::vector<SE3> ends = {SE3(), T_from_to};
    for (SE3& pose : ends) {
      Vector6d error;
      for (int k = 0; k < 6; ++k) error[k] = random.normal(0, kSigma[k]);
      pose = pose.plus(error);
    }
    const Vector6d e = (T_from_to.inverse() * ends[0].inverse() * ends[1]).log();
    found += e * e.transpose() / kDraws;
  }
  EXPECT_LT((found - noise.covariance(T_from_to, 1)).norm(), 0.03 * found.norm());
}

TEST(TruthNoise, OfTheDirectionGrowsWithTheLength) {
  TruthNoise noise;
  noise.direction = {{1, 0.02, 0.01}, {4, 0.01, 0.005}};
  const SE3 ahead(SO3(), Eigen::Vector3d(0, 0, 3));
  const Matrix6d one = noise.covariance(ahead, 1), many = noise.covariance(ahead, -7);
  EXPECT_NEAR(std::sqrt(one(0, 0)), 0.06, 1e-12);
  EXPECT_NEAR(std::sqrt(one(1, 1)), 0.03, 1e-12);
  EXPECT_NEAR(one(2, 2), 0, 1e-15);
  EXPECT_NEAR(std::sqrt(many(0, 0)), 0.03, 1e-12);
}

TEST(TruthNoise, NeedsPosesInARow) {
  EXPECT_FALSE(estimate_truth_noise(trajectory_of(hand_held(19))).outcome);
  EXPECT_FALSE(estimate_truth_noise(Trajectory()).outcome);
  Trajectory gaps = trajectory_of(hand_held(200));
  for (std::size_t i = 0; i < 200; i += 10) gaps.poses[i].T_world_body.reset();
  EXPECT_FALSE(estimate_truth_noise(gaps).outcome);
  gaps = trajectory_of(hand_held(200));
  gaps.poses[100].T_world_body.reset();
  EXPECT_TRUE(estimate_truth_noise(gaps).outcome);
}

}  // namespace truth_noise_test
}  // namespace placegraph
