#include <gtest/gtest.h>
#include <placegraph/frontend/planes/homography.h>
#include <placegraph/graph/core/error.h>

#include "tests/support/scenes/scene.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace homography_test {

using namespace test;
const Camera kCamera = pinhole(640, 480, 500);
const Eigen::Matrix3d kK = kCamera.K();

struct Case {
  Plane plane_ref;
  SE3 T_cur_ref;
  PointScene scene;  // on the plane; views: reference, current
};

Case random_case(Random& random) {
  Case c;
  c.plane_ref = {
      Eigen::Vector3d(random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4), 1).normalized(),
      random.uniform(4, 8)};
  Eigen::Vector3d w, t;
  for (int i = 0; i < 3; ++i) {
    w[i] = random.uniform(-0.08, 0.08);
    t[i] = random.uniform(-0.7, 0.7);
  }
  c.T_cur_ref = pose(w, t);
  c.scene = make_scene(kCamera, {SE3(), c.T_cur_ref.inverse()}, 40, random,
                       on_plane(c.plane_ref.normal, c.plane_ref.distance_m));
  return c;
}

TEST(Homography, CarriesPixelsOfThePlaneFromViewToView) {
  Random random = seeded_random(51);
  for (int run = 0; run < 20; ++run) {
    const Case c = random_case(random);
    const Eigen::Matrix3d H = homography_from_plane(kK, c.T_cur_ref, c.plane_ref);
    ASSERT_GT(c.scene.px[0].size(), 20u);
    for (std::size_t i = 0; i < c.scene.px[0].size(); ++i)
      EXPECT_LT(((H * c.scene.px[0][i].homogeneous()).hnormalized() - c.scene.px[1][i]).norm(),
                1e-8);
  }
}

TEST(Homography, CarriesThePlaneItself) {
  Random random = seeded_random(52);
  for (int run = 0; run < 20; ++run) {
    const Case c = random_case(random);
    const Plane plane_cur = transform(c.T_cur_ref, c.plane_ref);
    EXPECT_NEAR(plane_cur.normal.norm(), 1, 1e-12);
    for (const Eigen::Vector3d& point : c.scene.points_ref)
      EXPECT_NEAR(plane_cur.normal.dot(c.T_cur_ref * point), plane_cur.distance_m, 1e-9);
    const Plane back = transform(c.T_cur_ref.inverse(), plane_cur);
    EXPECT_LT((back.normal - c.plane_ref.normal).norm(), 1e-12);
    EXPECT_NEAR(back.distance_m, c.plane_ref.distance_m, 1e-12);
    // The homography back is the inverse of the one forth.
    Eigen::Matrix3d round = homography_from_plane(kK, c.T_cur_ref.inverse(), plane_cur) *
                            homography_from_plane(kK, c.T_cur_ref, c.plane_ref);
    round /= round(2, 2);
    EXPECT_LT((round - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST(Homography, HoldsTheTruthAmongItsReadings) {
  Random random = seeded_random(53);
  for (int run = 0; run < 20; ++run) {
    const Case c = random_case(random);
    // Any scale and either sign.
    const Eigen::Matrix3d H =
        (run % 2 ? -2.7 : 0.3) * homography_from_plane(kK, c.T_cur_ref, c.plane_ref);
    const auto motions = decompose_homography(kK, H, c.scene.px[0]);
    EXPECT_LE(motions.size(), 2u);
    double best = 1;
    for (const HomographyMotion& m : motions)
      best = std::min(
          best, angle_rad(m.T_cur_ref, c.T_cur_ref) +
                    (c.plane_ref.distance_m * m.T_cur_ref.translation() - c.T_cur_ref.translation())
                        .norm() +
                    (m.normal_ref - c.plane_ref.normal).norm());
    EXPECT_LT(best, 1e-6);
  }
}

TEST(Homography, HasOneExactReadingForAKnownNormal) {
  Random random = seeded_random(54);
  for (int run = 0; run < 20; ++run) {
    const Case c = random_case(random);
    const Eigen::Matrix3d H =
        (run % 2 ? -0.4 : 5) * homography_from_plane(kK, c.T_cur_ref, c.plane_ref);
    const SE3 T_cur_ref = motion_from_homography(kK, H, c.plane_ref.normal);
    EXPECT_LT(angle_rad(T_cur_ref, c.T_cur_ref), 1e-9);
    EXPECT_LT((c.plane_ref.distance_m * T_cur_ref.translation() - c.T_cur_ref.translation()).norm(),
              1e-9);
  }
}

TEST(Homography, OfARotationHasNoTranslation) {
  const SE3 T_cur_ref = pose({0.05, -0.1, 0.2}, {0, 0, 0});
  const Eigen::Matrix3d H = kK * T_cur_ref.rotation().matrix() * kK.inverse();
  const SE3 read = motion_from_homography(kK, H, Eigen::Vector3d::UnitY());
  EXPECT_LT(angle_rad(read, T_cur_ref), 1e-9);
  EXPECT_LT(read.translation().norm(), 1e-9);
}

TEST(Homography, RefusesWhatIsNone) {
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
  EXPECT_THROW(motion_from_homography(kK, identity, {0, 1, 0.01}), ArgumentError);
  EXPECT_THROW(motion_from_homography(kK, Eigen::Matrix3d::Zero(), {0, 1, 0}), ArgumentError);
  EXPECT_THROW(decompose_homography(kK, Eigen::Vector3d(1, 0, 0).asDiagonal(), {}), ArgumentError);
  EXPECT_THROW(homography_from_plane(kK, SE3(), {Eigen::Vector3d::UnitY(), 0}), ArgumentError);
}

}  // namespace homography_test
}  // namespace placegraph
