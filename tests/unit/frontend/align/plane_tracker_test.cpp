#include <gtest/gtest.h>
#include <placegraph/frontend/align/null_distribution.h>
#include <placegraph/frontend/align/plane_tracker.h>
#include <placegraph/frontend/align/warp.h>
#include <placegraph/frontend/planes/plane_normal.h>
#include <placegraph/graph/core/error.h>

#include <cmath>
#include <numbers>

#include "tests/support/scenes/board.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace plane_tracker_test {

using namespace test;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Code = Outcome::Code;

using Corners = std::array<Vector2d, 4>;
const Corners kBox = {Vector2d(10, 20), Vector2d(30, 20), Vector2d(30, 40), Vector2d(10, 40)};

TEST(HomographyOfBox, DoublesAndMovesASquare) {
  const auto H = homography_of_box(kBox, {Vector2d(0, 0), {40, 0}, {40, 40}, {0, 40}});
  ASSERT_TRUE(H);
  EXPECT_LT((*map_pixel(*H, {15, 25}) - Vector2d(10, 10)).norm(), 1e-12);
}

TEST(HomographyOfBox, TakesTheCornersToAnyConvexQuadrilateral) {
  const Corners to = {Vector2d(3, 1), {50, -4}, {44, 61}, {-7, 38}};
  const auto H = homography_of_box(kBox, to);
  ASSERT_TRUE(H);
  for (std::size_t c = 0; c < 4; ++c) EXPECT_LT((*map_pixel(*H, kBox[c]) - to[c]).norm(), 1e-9);
}

TEST(HomographyOfBox, RefusesWhatNoCameraSees) {
  EXPECT_FALSE(homography_of_box(kBox, {Vector2d(0, 0), {40, 40}, {40, 0}, {0, 40}})) << "crossed";
  EXPECT_FALSE(homography_of_box(kBox, {Vector2d(0, 0), {0, 40}, {40, 40}, {40, 0}})) << "mirrored";
  EXPECT_FALSE(homography_of_box(kBox, {Vector2d(0, 0), {40, 0}, {10, 10}, {0, 40}})) << "concave";
  EXPECT_FALSE(homography_of_box(kBox, {Vector2d(0, 0), {20, 0}, {40, 0}, {0, 40}})) << "flat";
}

Matrix3d calibration() {
  Matrix3d K;
  K << 300, 0, 160, 0, 300, 120, 0, 0, 1;
  return K;
}

TEST(PlanarWarp, FindsTheMemberOfItsFamilyThatIsAHomography) {
  const Plane plane{Vector3d(0.1, 0.2, 0.97).normalized(), 2};
  const SE3 T = SE3::exp((Vector6d() << 0.1, -0.2, 0.15, 0.03, -0.05, 0.1).finished());
  const auto rigid = PlanarWarp::rigid_motion(calibration(), T, plane);
  const auto again =
      PlanarWarp::rigid_motion(calibration(), SE3(), plane).at(3 * rigid.H_cur_ref());
  EXPECT_LT((again.T_cur_ref()->inverse() * T).log().norm(), 1e-9);
  const SE2 along(0.1, -0.3, 0.4);
  const auto planar = PlanarWarp::planar_motion(calibration(), along, plane);
  const auto found = PlanarWarp::planar_motion(calibration(), SE2(), plane).at(planar.H_cur_ref());
  EXPECT_LT((found.planar_T_cur_ref()->inverse() * along).log().norm(), 1e-9);
  const auto bare = PlanarWarp::homography(Matrix3d::Identity(), {5, 6}, 7).at(rigid.H_cur_ref());
  EXPECT_EQ(bare.dof(), 8);
  EXPECT_LT((*map_pixel(bare.H_cur_ref(), {9, 9}) - *map_pixel(rigid.H_cur_ref(), {9, 9})).norm(),
            1e-9);
}

const std::vector<Vector2d> kRegion = {{100, 80}, {220, 80}, {220, 160}, {100, 160}};

PlaneNormalEstimator estimator_of(const Plane& plane, int views, double step) {
  PlaneNormalEstimator estimator(calibration(), kRegion, {});
  for (int i = 1; i <= views; ++i) {
    const Vector6d x = step * i * (Vector6d() << 0.1, 0.04, -0.05, 0.05, -0.1, 0.02).finished() +
                       0.02 * (i % 3) * Vector6d::Unit(1);
    EXPECT_TRUE(estimator.add(homography_from_plane(calibration(), SE3::exp(x), plane)));
  }
  return estimator;
}

TEST(PlaneNormal, IsTheOneReadingThatAllViewsShare) {
  const Plane plane{Vector3d(0.3, -0.2, 0.93).normalized(), 1};
  const PlaneNormal normal = estimator_of(plane, 4, 1).estimate();
  ASSERT_TRUE(normal.outcome) << normal.outcome.reason;
  EXPECT_EQ(normal.views, 4);
  EXPECT_LT((normal.normal_ref - plane.normal).norm(), 1e-5);
}

TEST(PlaneNormal, IsOpenWithoutViewsOrAfterARotation) {
  PlaneNormalEstimator estimator(calibration(), kRegion, {});
  EXPECT_EQ(estimator.estimate().outcome.code, Code::kTooFewData);
  EXPECT_FALSE(estimator.add(Matrix3d::Identity()));
  for (int i = 1; i <= 3; ++i) {
    const SE3 rotation(SO3::exp(0.05 * i * Vector3d(0.5, 1, 0.2)), Vector3d::Zero());
    EXPECT_TRUE(
        estimator.add(homography_from_plane(calibration(), rotation, {Vector3d::UnitZ(), 1})));
  }
  EXPECT_EQ(estimator.estimate().outcome.code, Code::kDegenerate);
}

TEST(PlaneNormal, HasTwoReadingsInOneView) {
  const Plane plane{Vector3d(0.3, -0.2, 0.93).normalized(), 1};
  EXPECT_EQ(estimator_of(plane, 1, 1).estimate().outcome.code, Code::kDegenerate);
}

/// A board small enough to calibrate a tracker in milliseconds.
struct SmallBoard : Board {
  explicit SmallBoard(Random& random) : Board(random) {
    width = height = 96;
    corners = {{30, 30}, {64, 30}, {64, 62}, {30, 62}};
    texture.wavelength = background.wavelength = 14;
    texture.octaves = background.octaves = 2;
  }
};

PlaneTrackerOptions quick() {
  PlaneTrackerOptions options;
  options.chance_trials = 2;
  options.levels = 2;
  options.align.swarm.particles = 6;
  options.align.swarm.generations = 3;
  options.align.followed = 1;
  return options;
}

TEST(PlaneTracker, SaysWhereTheTemplateIsAndThatItIsGone) {
  Random random = seeded_random(111);
  const SmallBoard board(random);
  PlaneTracker tracker(board.picture(Matrix3d::Identity()), board.corners, quick());
  ASSERT_TRUE(tracker.outcome()) << tracker.outcome().reason;
  Matrix3d moved = Matrix3d::Identity();
  moved(0, 2) = 1.5;
  const PlaneTrack seen = tracker.track(board.picture(moved));
  ASSERT_TRUE(seen.outcome) << seen.outcome.reason;
  ASSERT_EQ(seen.corners_px.size(), 4u);
  EXPECT_LT(board.error_px(seen.corners_px, moved), 0.3);
  EXPECT_GT(seen.similarity, 0.9);
  EXPECT_FALSE(seen.T_cur_ref);
  const PlaneTrack gone = tracker.track(Image(96, 96, CV_8UC1, cv::Scalar(90)));
  EXPECT_FALSE(gone.outcome);
  EXPECT_FALSE(gone.outcome.reason.empty());
  EXPECT_TRUE(gone.corners_px.empty());
}

TEST(PlaneTracker, SaysThatATemplateCannotBeTracked) {
  const Image blank(96, 96, CV_8UC1, cv::Scalar(90));
  PlaneTracker none(blank, {{30, 30}, {64, 30}, {64, 62}, {30, 62}}, quick());
  EXPECT_EQ(none.outcome().code, Code::kDegenerate);
  EXPECT_EQ(none.track(blank).outcome.code, Code::kDegenerate);
  PlaneTracker tiny(blank, {{30, 30}, {35, 30}, {35, 35}, {30, 35}}, quick());
  EXPECT_EQ(tiny.outcome().code, Code::kTooFewData);
}

TEST(PlaneTracker, RefusesCornersThatAreNoQuadrilateralAndModelsWithoutACamera) {
  const Image image(96, 96, CV_8UC1, cv::Scalar(90));
  EXPECT_THROW(PlaneTracker(image, {{30, 30}, {64, 62}, {64, 30}, {30, 62}}, quick()),
               ArgumentError);
  EXPECT_THROW(PlaneTracker(image, {{30, 30}, {64, 30}, {64, 62}}, quick()), ArgumentError);
  PlaneTrackerOptions rigid = quick();
  rigid.model = PlaneModel::kSe3Plane;
  EXPECT_THROW(PlaneTracker(image, {{30, 30}, {64, 30}, {64, 62}, {30, 62}}, rigid), ArgumentError);
  PlaneTrackerOptions broken = quick();
  broken.max_area_change = 0.5;
  EXPECT_THROW(PlaneTracker(image, {{30, 30}, {64, 30}, {64, 62}, {30, 62}}, broken),
               ArgumentError);
}

TEST(NullDistribution, KnowsATextureThatRepeats) {
  Random random = seeded_random(112);
  SmallBoard board(random);
  const std::vector<Vector2d>& corners = board.corners;
  const PlaneTrackerOptions options = quick();
  const Image once = board.picture(Matrix3d::Identity());
  Image often(96, 96, CV_8UC1);
  for (int v = 0; v < 96; ++v)
    for (int u = 0; u < 96; ++u)
      often.at<std::uint8_t>(v, u) = to_grey(128 + 50 * std::sin(2 * std::numbers::pi * u / 8) *
                                                       std::sin(2 * std::numbers::pi * v / 8));
  AlignOptions esm = options.align;
  esm.optimizer = AlignOptimizer::kEsm;
  const auto of = [&](const Image& image) {
    return null_distribution(image, corners, PlanarTemplate(image, corners, 2, 3000), esm, 3);
  };
  const NullDistribution unique = of(once);
  EXPECT_LT(unique.rival, 0.6);
  EXPECT_LT(unique.bound(2), 0.7);
  EXPECT_EQ(unique.trials, 3);
  EXPECT_GT(of(often).rival, 0.9);
  EXPECT_THROW(std::ignore =
                   null_distribution(once, corners, PlanarTemplate(once, corners, 2, 3000), esm, 1),
               ArgumentError);
}

}  // namespace plane_tracker_test
}  // namespace placegraph
