#include <gtest/gtest.h>
#include <placegraph/frontend/relative_pose/relative_pose.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Cholesky>

#include "tests/support/scenes/scene.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace pose_3d3d_test {

using namespace test;
using Code = Outcome::Code;
const Camera kCamera = pinhole(640, 480, 500);
const SE3 kTruth = pose({0.1, -0.2, 0.05}, {0.6, -0.3, 0.8});  // T_ref_cur
constexpr double kSigmaPx = 0.5;
constexpr double kSigmaInverseDepth = 0.5 / (500 * 0.5);  // stereo: half a pixel at half a metre

struct Clouds {
  std::vector<CloudPoint> ref, cur;
};

/// Both clouds as a stereo camera sees them, noise and all.
Clouds stereo_clouds(int count, double noise, Random& random) {
  const PointScene scene = make_scene(kCamera, {SE3(), kTruth}, count, random);
  Clouds clouds;
  for (int view = 0; view < 2; ++view)
    for (int i = 0; i < count; ++i) {
      const Eigen::Vector3d p_cam = scene.T_ref_cam[view].inverse() * scene.points_ref[i];
      Eigen::Vector2d px = scene.px[view][i];
      px += noise * kSigmaPx * Eigen::Vector2d(random.normal(), random.normal());
      const double inverse = 1 / p_cam.z() + noise * kSigmaInverseDepth * random.normal();
      (view == 0 ? clouds.ref : clouds.cur)
          .push_back(cloud_point(kCamera, px, inverse, kSigmaPx, kSigmaInverseDepth));
    }
  return clouds;
}

TEST(CloudPoint, SpreadsAlongItsRayWithTheSquareOfTheDepth) {
  Camera camera;
  camera.width = 200, camera.height = 100;
  camera.fx = camera.fy = 100;
  camera.cx = 100, camera.cy = 50;
  const CloudPoint p = cloud_point(camera, {100, 50}, 0.25, 0.5, 0.01);
  EXPECT_TRUE(p.point.isApprox(Eigen::Vector3d(0, 0, 4)));
  EXPECT_NEAR(p.covariance(2, 2), 0.16 * 0.16, 1e-12);  // 4^2 0.01
  EXPECT_NEAR(p.covariance(0, 0), 0.02 * 0.02, 1e-12);  // 4 0.5 / 100
  EXPECT_THROW((void)cloud_point(camera, {100, 50}, 0, 0.5, 0.01), ArgumentError);
}

TEST(Pose3d3d, IsExactWithoutNoise) {
  Random random = seeded_random(51);
  const Clouds clouds = stereo_clouds(60, 0, random);
  const auto result = estimate_pose_3d3d(clouds.ref, clouds.cur, {}, random);
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  EXPECT_EQ(result.inliers.size(), 60u);
  EXPECT_LT(distance_m(result.T_ref_cur, kTruth), 1e-7);
  EXPECT_LT(angle_rad(result.T_ref_cur, kTruth), 1e-7);
}

TEST(Pose3d3d, FindsThePoseAmongHalfOutliers) {
  Random random = seeded_random(52);
  Clouds clouds = stereo_clouds(120, 1, random);
  for (std::size_t i = 0; i < clouds.cur.size(); i += 2)
    clouds.cur[i].point += Eigen::Vector3d(random.uniform(-4, 4), random.uniform(2, 5), 1);
  const auto result = estimate_pose_3d3d(clouds.ref, clouds.cur, {}, random);
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  for (const int i : result.inliers) EXPECT_EQ(i % 2, 1) << i;
  EXPECT_GT(result.inliers.size(), 54u);
  const Vector6d error = (kTruth.inverse() * result.T_ref_cur).log();
  EXPECT_LT(error.dot(result.information * error), 27.9);  // chi2 of 6, 99.99 %
}

TEST(Pose3d3d, ClaimsACovarianceThatItsErrorsBearOut) {
  Random random = seeded_random(53);
  constexpr int kRuns = 60;
  double nees = 0;
  for (int run = 0; run < kRuns; ++run) {
    const Clouds clouds = stereo_clouds(80, 1, random);
    const auto result = estimate_pose_3d3d(clouds.ref, clouds.cur, {}, random);
    ASSERT_TRUE(result.outcome);
    const Vector6d error = (kTruth.inverse() * result.T_ref_cur).log();
    nees += error.dot(result.information * error) / kRuns;
  }
  // chi2 of 6 over 60 runs: 99.9 % lie within 6 +- 3.29 sqrt(12 / 60). Huber's weights make the
  // claim a little too modest or the depths' curvature a little too bold: a tenth more.
  EXPECT_GT(nees, 0.9 * (6 - 3.29 * std::sqrt(12.0 / kRuns)));
  EXPECT_LT(nees, 1.1 * (6 + 3.29 * std::sqrt(12.0 / kRuns)));
}

TEST(Pose3d3d, SaysThatPointsOnALineFixNoPose) {
  Random random = seeded_random(54);
  std::vector<CloudPoint> ref, cur;
  for (int i = 0; i < 40; ++i) {
    const Eigen::Vector3d p = Eigen::Vector3d(0.1, 0.2, 5) + 0.1 * i * Eigen::Vector3d(1, 0.5, 0);
    ref.push_back({p, 1e-4 * Eigen::Matrix3d::Identity()});
    cur.push_back({kTruth.inverse() * p, 1e-4 * Eigen::Matrix3d::Identity()});
  }
  const auto result = estimate_pose_3d3d(ref, cur, {}, random);
  EXPECT_FALSE(result.outcome);
}

TEST(Pose3d3d, SaysThatANearlyStraightCloudLeavesARotationOpen) {
  Random random = seeded_random(55);
  std::vector<CloudPoint> ref, cur;
  for (int i = 0; i < 40; ++i) {
    // A needle: 2 % thick against its length, far from the origin.
    const Eigen::Vector3d p =
        Eigen::Vector3d(0.1 * i, 0.02 * (i % 2), 0.02 * (i % 3)) + Eigen::Vector3d(0, 0, 500);
    ref.push_back({p, Eigen::Matrix3d::Identity()});
    cur.push_back({kTruth.inverse() * p, Eigen::Matrix3d::Identity()});
  }
  const auto result = estimate_pose_3d3d(ref, cur, {}, random);
  EXPECT_EQ(result.outcome.code, Code::kDegenerate);
}

TEST(Pose3d3d, RefusesWhatCannotBe) {
  Random random = seeded_random(56);
  Clouds clouds = stereo_clouds(8, 1, random);
  EXPECT_EQ(estimate_pose_3d3d(clouds.ref, clouds.cur, {}, random).outcome.code, Code::kTooFewData);
  clouds = stereo_clouds(40, 1, random);
  for (CloudPoint& p : clouds.cur)
    p.point = {random.uniform(-30, 30), random.uniform(-30, 30), random.uniform(-30, 30)};
  EXPECT_EQ(estimate_pose_3d3d(clouds.ref, clouds.cur, {}, random).outcome.code,
            Code::kNoConsensus);
  EXPECT_THROW((void)estimate_pose_3d3d(clouds.ref, {}, {}, random), ArgumentError);
}

}  // namespace pose_3d3d_test
}  // namespace placegraph
