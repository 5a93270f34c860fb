#include <placegraph/pipeline/map/map_bundle.h>

#include "tests/support/scenes/observed_map.h"
#include "tests/support/scenes/poses.h"

namespace placegraph {
namespace map_bundle_test {

constexpr int kViews = 6, kPoints = 120;

class MapBundleTest : public testing::Test {
 protected:
  MapBundleTest()
      : scene(test::make_scene(test::pinhole(640, 480, 500), test::sideways(kViews), kPoints,
                               random)) {}
  /// The map of the scene with noise in what was estimated: poses but the first one, and points.
  Map disturbed() {
    Map map = test::observed_map(scene);
    for (std::size_t i = 1; i < map.place_graph.places.size(); ++i) {
      SE3& T = map.place_graph.places[i].T_map_place;
      T = T * test::random_motion(random, 0.01, 0.004);
    }
    for (PointLandmark& landmark : map.landmarks) landmark.point_cam *= 1 + random.normal(0, 0.02);
    return map;
  }
  Random random{5};
  test::PointScene scene;
};

TEST_F(MapBundleTest, FindsPosesAndPointsBehindExactObservations) {
  const MapBundle bundle = adjust_map(disturbed(), 0, scene.camera);
  ASSERT_TRUE(bundle.outcome) << bundle.outcome.reason;
  EXPECT_EQ(bundle.offered, std::size_t{kViews * kPoints});
  EXPECT_EQ(bundle.kept, bundle.offered);
  EXPECT_EQ(bundle.points.size(), std::size_t{kPoints});
  EXPECT_GT(bundle.error_before_px, 1);  // 0.004 rad are 2 px
  // The disturbed relative poses pull against exact observations, 500 times as certain.
  EXPECT_LT(bundle.error_px, 0.05);
  ASSERT_EQ(bundle.views.size(), std::size_t{kViews});
  EXPECT_LT(test::distance_m(bundle.views[0].T_map_cam, scene.T_ref_cam[0]), 1e-12);
  // The scale is known by the disturbed steps of 0.5 m alone: about 0.01 / 0.5 / sqrt(5) of 2.5 m.
  for (std::size_t i = 0; i < kViews; ++i) {
    EXPECT_LT(test::distance_m(bundle.views[i].T_map_cam, scene.T_ref_cam[i]), 0.07) << i;
    EXPECT_LT(test::angle_rad(bundle.views[i].T_map_cam, scene.T_ref_cam[i]), 0.001) << i;
  }
  for (const MapBundle::Point& point : bundle.points) EXPECT_EQ(point.views, kViews);
}

TEST_F(MapBundleTest, LeavesFalseObservationsOut) {
  int spoilt = 0;
  for (int view = 0; view < kViews; ++view)  // no point twice
    spoilt +=
        test::spoil(scene.camera, scene.px[static_cast<std::size_t>(view)], 3 * view, 20, random);
  const MapBundle bundle = adjust_map(disturbed(), 0, scene.camera);
  ASSERT_TRUE(bundle.outcome) << bundle.outcome.reason;
  EXPECT_LE(bundle.kept, bundle.offered - static_cast<std::size_t>(spoilt));
  EXPECT_GE(bundle.kept, bundle.offered - static_cast<std::size_t>(spoilt) - 20);
  EXPECT_LT(bundle.error_px, 0.1);
  std::vector<int> views(bundle.points.size(), 0);
  for (const MapBundle::View& view : bundle.views)
    for (const MapBundle::Observation& observation : view.observations)
      ++views[static_cast<std::size_t>(observation.point)];
  for (std::size_t i = 0; i < views.size(); ++i) {
    EXPECT_EQ(views[i], bundle.points[i].views);
    EXPECT_GE(views[i], 2);
  }
}

TEST_F(MapBundleTest, IgnoresLandmarksThatAreNotInTheMapAndTheSecondCamera) {
  Map map = test::observed_map(scene);
  map.landmarks.pop_back();
  for (Keyframe& keyframe : map.keyframes) keyframe.observations[0].camera = 1;
  const MapBundle bundle = adjust_map(map, 0, scene.camera);
  EXPECT_EQ(bundle.offered, std::size_t{kViews * (kPoints - 2)});
  ASSERT_EQ(bundle.points.size(), std::size_t{kPoints - 2});
  EXPECT_EQ(bundle.points[0].landmark.id, LandmarkId(1));
}

TEST_F(MapBundleTest, NeedsLandmarksThatTwoKeyframesObserve) {
  Map map = test::observed_map(scene);
  for (std::size_t i = 1; i < map.keyframes.size(); ++i) map.keyframes[i].observations.clear();
  const MapBundle bundle = adjust_map(map, 0, scene.camera);
  EXPECT_EQ(bundle.outcome.code, Outcome::Code::kTooFewData);
  EXPECT_EQ(bundle.offered, std::size_t{kPoints});
  EXPECT_TRUE(bundle.points.empty());
}

}  // namespace map_bundle_test
}  // namespace placegraph
