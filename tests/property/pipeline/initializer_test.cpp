#include <gtest/gtest.h>
#include <placegraph/pipeline/odometry/two_view_initializer.h>

#include "tests/support/scenes/beginning.h"
#include "tests/support/scenes/street.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace initializer_test {

using namespace test;

/// Two views of the street, a random step apart.
struct Pair {
  SE3 T_a_b;
  Image a, b;
  Camera camera = street_camera();

  explicit Pair(Random& random, bool rotates_alone = false) {
    const SE3 T_world_a = pose({random.uniform(-0.02, 0.02), random.uniform(-0.05, 0.05), 0},
                               {random.uniform(-1, 1), -kStreetHeight_m, random.uniform(0, 6)});
    const double yaw = random.uniform(0.01, 0.03) * (random.index(2) == 0 ? 1 : -1);
    T_a_b = rotates_alone
                ? pose({0, yaw, random.uniform(-0.01, 0.01)}, {0, 0, 0})
                : pose({0, 0.3 * yaw, 0}, {random.uniform(-0.2, 0.2), 0, random.uniform(0.4, 0.7)});
    a = render(camera, T_world_a, street(), 2).grey;
    b = render(camera, T_world_a * T_a_b, street(), 2).grey;
  }
};
/// A map that two views begin.
struct PairBeginning : Beginning<TwoViewInitializer> {
  Initialization last;

  PairBeginning(const Camera& camera, const Image& first, const Image& second,
                const SE3& T_odom_first = SE3(), std::optional<double> median_depth = {})
      : Beginning(of(camera), "points", Scale::kArbitrary, T_odom_first) {
    map.restart(median_depth ? Scale::kGuessed : Scale::kArbitrary, median_depth);
    (void)add(0, first);
    last = add(1, second);
  }
  static Calibration of(const Camera& camera) {
    Calibration calibration;
    calibration.camera = camera;
    return calibration;
  }
  Initialization add(std::int64_t id, const Image& image) {
    Frame frame;
    frame.id = FrameId(id);
    frame.stamp_ns = 100'000'000 * id;
    frame.image = image;
    return Beginning::add(frame);
  }
  bool begun() const { return last.state == TrackingState::kTracking; }
};

/// Tracks of 0.25 px at 330 px focal length, over a hundred of them: the rotation of two views is
/// known to a milliradian or two, the direction of the way to some tens of them.
constexpr double kAngleRad = 0.004, kDirectionRad = 0.06;

TEST(TwoViewLaws, TheFrameOfTheOdometryMovesPosesAndLandmarks) {
  Random random = seeded_random(1);
  for (int trial = 0; trial < 3; ++trial) {
    const Pair pair(random);
    const SE3 T_other = SE3::exp(Vector6d::NullaryExpr([&] { return random.uniform(-2, 2); }));
    const PairBeginning here(pair.camera, pair.a, pair.b),
        there(pair.camera, pair.a, pair.b, T_other);
    ASSERT_TRUE(here.begun() && there.begun());
    // The descent ends within a thousandth of its cost, along directions that two views hardly
    // tell.
    EXPECT_LT(angle_rad(here.motion(), there.motion()), 0.5 * kAngleRad);
    EXPECT_LT(distance_m(here.motion(), there.motion()),
              kDirectionRad * here.motion().translation().norm());
    const auto ids = here.map.window().landmarks();
    ASSERT_EQ(ids, there.map.window().landmarks());
    int moved = 0;  // most: not those far ahead, whose depth hardly shows
    for (const LandmarkId id : ids) {
      const Eigen::Vector3d p = *here.map.window().landmark(LandmarkId(id));
      moved +=
          (T_other * p - *there.map.window().landmark(LandmarkId(id))).norm() < 0.05 * p.norm();
    }
    EXPECT_GT(moved, 0.8 * static_cast<double>(ids.size()));
  }
}

TEST(TwoViewLaws, LengthsGrowWithTheDepthThatIsGuessed) {
  Random random = seeded_random(2);
  for (int trial = 0; trial < 3; ++trial) {
    const Pair pair(random);
    const double depth = random.uniform(1, 40);
    const PairBeginning one(pair.camera, pair.a, pair.b, SE3(), 1.0),
        many(pair.camera, pair.a, pair.b, SE3(), depth);
    ASSERT_TRUE(one.begun() && many.begun());
    EXPECT_LT(angle_rad(one.motion(), many.motion()), 1e-4);
    EXPECT_LT(distance_m(one.motion().scaled(depth), many.motion()),
              1e-3 * many.motion().translation().norm());
  }
}

TEST(TwoViewLaws, ExchangedViewsSeeTheInverseMotion) {
  Random random = seeded_random(3);
  for (int trial = 0; trial < 4; ++trial) {
    const Pair pair(random);
    const PairBeginning forwards(pair.camera, pair.a, pair.b),
        backwards(pair.camera, pair.b, pair.a);
    ASSERT_TRUE(forwards.begun() && backwards.begun());
    const SE3 there = forwards.motion(), back = backwards.motion().inverse();
    EXPECT_LT(angle_rad(there, back), kAngleRad);
    EXPECT_LT(angle_between(there.translation(), back.translation()), kDirectionRad);
    EXPECT_LT(angle_rad(there, pair.T_a_b), kAngleRad);
    EXPECT_LT(angle_between(there.translation(), pair.T_a_b.translation()), kDirectionRad);
  }
}

TEST(TwoViewLaws, AMirrorShowsTheMirroredMotion) {
  Random random = seeded_random(4);
  for (int trial = 0; trial < 4; ++trial) {
    const Pair pair(random);
    Camera mirror = pair.camera;
    mirror.cx = mirror.width - 1 - mirror.cx;
    const PairBeginning direct(pair.camera, pair.a, pair.b),
        mirrored(mirror, flipped(pair.a), flipped(pair.b));
    ASSERT_TRUE(direct.begun() && mirrored.begun());
    const Eigen::Vector3d w = direct.motion().rotation().log(), t = direct.motion().translation();
    const SE3 expected = pose({w.x(), -w.y(), -w.z()}, {-t.x(), t.y(), t.z()});
    EXPECT_LT(angle_rad(mirrored.motion(), expected), kAngleRad);
    EXPECT_LT(angle_between(mirrored.motion().translation(), expected.translation()),
              kDirectionRad);
  }
}

TEST(TwoViewLaws, ARotationBackIsTheInverse) {
  Random random = seeded_random(5);
  for (int trial = 0; trial < 4; ++trial) {
    const Pair pair(random, true);
    const PairBeginning forwards(pair.camera, pair.a, pair.b),
        backwards(pair.camera, pair.b, pair.a);
    ASSERT_FALSE(forwards.begun() || backwards.begun());
    ASSERT_TRUE(forwards.last.rotation && backwards.last.rotation);
    const SO3 there = forwards.last.rotation->R_before_cam,
              back = backwards.last.rotation->R_before_cam;
    EXPECT_LT((there * back).log().norm(), 0.002);
    EXPECT_LT((there.inverse() * pair.T_a_b.rotation()).log().norm(), 0.002);
    // The covariance is honest: an error beyond four deviations is not met in a handful of draws.
    const Eigen::Vector3d off = (there.inverse() * pair.T_a_b.rotation()).log();
    EXPECT_LT(off.dot(forwards.last.rotation->covariance.ldlt().solve(off)), 3 * 16);
  }
}

}  // namespace initializer_test
}  // namespace placegraph
