#include <gtest/gtest.h>
#include <placegraph/frontend/relative_pose/image_motion.h>

#include "tests/support/scenes/scene.h"

namespace placegraph {
namespace image_motion_test {

using namespace test;

const Camera kCamera = pinhole(640, 480, 500);

/// Pixels of random points before and after a motion, with noise.
struct Views {
  std::vector<Eigen::Vector2d> ref, cur;
};
Views views(const SE3& T_ref_cur) {
  Random random(3);
  Views views;
  while (views.ref.size() < 150) {
    const double z = random.uniform(3, 20);
    const Eigen::Vector3d point(random.uniform(-0.6, 0.6) * z, random.uniform(-0.45, 0.45) * z, z);
    const auto ref = kCamera.project(point), cur = kCamera.project(T_ref_cur.inverse() * point);
    if (!ref || !cur || !kCamera.contains(*ref) || !kCamera.contains(*cur)) continue;
    views.ref.push_back(*ref);
    views.cur.emplace_back(cur->x() + random.normal(0, 0.1), cur->y() + random.normal(0, 0.1));
  }
  return views;
}

std::optional<ImageMotion> motion(const Views& views) {
  Random random(1);
  return ImageMotion::estimate(kCamera, views.ref, views.cur, random);
}

TEST(ImageMotion, ARotationDisplacesEveryPoint) {
  const auto rotation = motion(views(pose({0, 0.02, 0}, {0, 0, 0})));
  ASSERT_TRUE(rotation);
  for (const double u : {50, 320, 600}) {
    const auto displacement = rotation->least_displacement({u, 100});
    ASSERT_TRUE(displacement);
    EXPECT_NEAR(displacement->px.norm(), 10, 5);  // f times the angle, more at the sides
    EXPECT_LT(displacement->px.x(), 0);
    EXPECT_LT(displacement->sigma_px, 0.5);
  }
}

TEST(ImageMotion, ATranslationLeavesFarPointsWhereTheyAre) {
  const auto translation = motion(views(pose({0, 0, 0}, {0.1, 0, 1})));
  ASSERT_TRUE(translation);
  for (const double u : {100, 300, 500})
    for (const double v : {100, 300}) {
      const auto displacement = translation->least_displacement({u, v});
      if (displacement) {
        EXPECT_LT(displacement->px.norm(), 0.1 + 4 * displacement->sigma_px);
      }
    }
}

TEST(ImageMotion, ARotationOnTheWayIsSeparatedFromTheTranslation) {
  // Ahead and to the left: the epipolar lines run away from the centre, the rotation to the side.
  const auto both = motion(views(pose({0, 0.02, 0}, {0, 0, 1})));
  ASSERT_TRUE(both);
  const auto above = both->least_displacement({320, 40});
  ASSERT_TRUE(above);
  EXPECT_GT(std::abs(above->px.x()), 5);
  EXPECT_LT(std::abs(above->px.y()), 5);
}

TEST(ImageMotion, ContradictoryPointsShowNone) {
  Views noise = views(SE3());
  Random random(5);
  for (Eigen::Vector2d& px : noise.cur) px = {random.uniform(0, 640), random.uniform(0, 480)};
  EXPECT_FALSE(motion(noise));
}

}  // namespace image_motion_test
}  // namespace placegraph
