#include <placegraph/pipeline/map/map_geometry.h>

#include "tests/support/scenes/observed_map.h"

namespace placegraph {
namespace map_geometry_test {

TEST(MapGeometry, HasTheScalesOfPlacesAndKeyframes) {
  Map map = test::posed_map({SE3(), SE3(SO3(), {0, 0, 4})});
  Place& place = map.place_graph.places[1];
  place.scale = 2;
  map.keyframes[1].T_place_keyframe = SE3(SO3(), {1, 0, 0});
  map.keyframes[1].scale = 3;
  PointLandmark& landmark = map.landmarks.emplace_back();
  landmark.id = LandmarkId(5);
  landmark.keyframe = KeyframeId(1);
  landmark.point_cam = {0, 0, 1};
  landmark.covariance = Eigen::Vector3d(0.01, 0.04, 0.09).asDiagonal();
  const MapGeometry geometry = geometry_of(map, 0);
  ASSERT_EQ(geometry.keyframes.size(), 2u);
  EXPECT_TRUE(geometry.keyframes[1].T_map_cam.translation().isApprox(Eigen::Vector3d(2, 0, 4)));
  ASSERT_EQ(geometry.landmarks.size(), 1u);
  EXPECT_EQ(geometry.landmarks[0].id, LandmarkId(5));
  EXPECT_TRUE(geometry.landmarks[0].p_map.isApprox(Eigen::Vector3d(2, 0, 10)));
  EXPECT_NEAR(geometry.landmarks[0].sigma.value(), 6 * 0.3, 1e-12);
  EXPECT_FALSE(geometry.landmarks[0].rgb);
}

TEST(MapGeometry, IsThatOfOneComponent) {
  Map map = test::posed_map({SE3(), SE3(SO3(), {1, 0, 0}), SE3(SO3(), {2, 0, 0})});
  map.place_graph.places[2].component = 2;
  for (int i = 0; i < 3; ++i) {
    PointLandmark& landmark = map.landmarks.emplace_back();
    landmark.id = LandmarkId(i);
    landmark.keyframe = KeyframeId(i);
  }
  EXPECT_EQ(geometry_of(map, 0).keyframes.size(), 2u);
  EXPECT_EQ(geometry_of(map, 0).landmarks.size(), 2u);
  const MapGeometry other = geometry_of(map, 2);
  ASSERT_EQ(other.keyframes.size(), 1u);
  EXPECT_EQ(other.keyframes[0].keyframe->id, KeyframeId(2));
  ASSERT_EQ(other.landmarks.size(), 1u);
  EXPECT_EQ(other.landmarks[0].keyframe, KeyframeId(2));
  EXPECT_FALSE(other.landmarks[0].sigma);
  EXPECT_TRUE(geometry_of(map, 7).keyframes.empty());
}

TEST(MapGeometry, IsThatOfAllComponentsUnlessOneIsNamed) {
  Map map = test::posed_map({SE3(), SE3(SO3(), {1, 0, 0}), SE3(SO3(), {2, 0, 0})});
  map.place_graph.places[2].component = 2;
  for (int i = 0; i < 4; ++i) {
    PointLandmark& landmark = map.landmarks.emplace_back();
    landmark.id = LandmarkId(i);
    landmark.keyframe = KeyframeId(i);  // the last one is not in the map
  }
  const MapGeometry geometry = geometry_of(map, std::nullopt);
  EXPECT_EQ(geometry.keyframes.size(), 3u);
  ASSERT_EQ(geometry.landmarks.size(), 3u);
  EXPECT_TRUE(geometry.landmarks[2].p_map.isApprox(Eigen::Vector3d(2, 0, 0)));
}

}  // namespace map_geometry_test
}  // namespace placegraph
