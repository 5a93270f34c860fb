#include <gtest/gtest.h>
#include <placegraph/pipeline/map/explanation.h>

#include "tests/support/scenes/scene.h"

namespace placegraph {
namespace explanation_test {

using namespace test;

/// Two places a metre apart, frame 0 in the first, frames 1 and 2 at the second's keyframe.
Map two_places() {
  Map map;
  for (int k = 0; k < 2; ++k) {
    Keyframe keyframe;
    keyframe.id = KeyframeId(k);
    keyframe.place = PlaceId(k);
    keyframe.frame = FrameId(k);
    keyframe.features.resize(5);
    keyframe.features[0].point_cam = Eigen::Vector3f(0, 0, 4);
    map.keyframes.push_back(keyframe);
    Place place;
    place.id = PlaceId(k);
    place.anchor_keyframe = KeyframeId(k);
    place.T_map_place = pose({0, 0.1 * k, 0}, {0, 0, 1.0 * k});
    place.members = {{KeyframeId(k), SE3(), 1}};
    if (k == 1) place.labels = {"corridor"};
    map.place_graph.places.push_back(place);
  }
  RelativePoseConstraint edge;
  edge.from = NodeId(0), edge.to = NodeId(1);
  edge.T_from_to = map.place_graph.places[1].T_map_place;
  edge.information = 100 * Matrix6d::Identity();
  edge.source = ConstraintSource::kOdometry;
  map.place_graph.constraints.push_back(edge);
  map.frames = {{FrameId(0), 0, KeyframeId(0), SE3(), 20},
                {FrameId(1), 10, KeyframeId(1), SE3(), 30},
                {FrameId(2), 20, KeyframeId(1), pose({0, 0, 0}, {0, 0, 0.5}), 40},
                {FrameId(3), 30, std::nullopt, std::nullopt, 0}};
  map.metric = true;
  LoopRecord accepted, refused;
  accepted.query_frame = FrameId(1), accepted.match_frame = FrameId(0);
  accepted.stage = LoopStage::kAccepted;
  refused.query_frame = FrameId(1), refused.match_frame = FrameId(0),
  refused.stage = LoopStage::kGeometry;
  map.loops = {accepted, refused};
  return map;
}

TEST(Explanation, TellsWhereAFrameIsAndHowThatIsKnown) {
  const Map map = two_places();
  const auto explained = explain_frame(map, FrameId(2));
  ASSERT_TRUE(explained);
  EXPECT_TRUE(explained->posed);
  EXPECT_EQ(explained->place, PlaceId(1));
  EXPECT_EQ(explained->labels, std::vector<std::string>{"corridor"});
  EXPECT_LT(
      distance_m(explained->T_map_cam, pose({0, 0.1, 0}, {0, 0, 1}) * pose({0, 0, 0}, {0, 0, 0.5})),
      1e-12);
  EXPECT_NEAR(explained->distance_to_keyframe, 0.5, 1e-12);
  EXPECT_EQ(explained->inliers, 40);
  EXPECT_EQ(explained->features, 5);
  EXPECT_EQ(explained->features_placed, 1);
  EXPECT_EQ(explained->constraints.at("odometry"), 1);
  // Those of its keyframe are its own.
  EXPECT_EQ(explained->loops.size(), 1u);
  EXPECT_EQ(explained->refused.size(), 1u);
}

TEST(Explanation, CarriesTheCovarianceOfThePlaceToTheFrame) {
  const Map map = two_places();
  const auto first = explain_frame(map, FrameId(0)), anchor = explain_frame(map, FrameId(1)),
             beyond = explain_frame(map, FrameId(2));
  ASSERT_TRUE(first->covariance && anchor->covariance && beyond->covariance);
  EXPECT_LT(first->covariance->norm(), 1e-12);  // held
  EXPECT_LT((*anchor->covariance - 0.01 * Matrix6d::Identity()).norm(), 1e-9);
  // Half a metre ahead an uncertain turn counts as an uncertain way: 0.01 + 0.5^2 0.01.
  EXPECT_NEAR((*beyond->covariance)(0, 0), 0.0125, 1e-9);
  EXPECT_NEAR((*beyond->covariance)(2, 2), 0.01, 1e-9);
  // A turn about y moves what is ahead in the direction of x.
  EXPECT_NEAR((*beyond->covariance)(0, 4), 0.005, 1e-9);
}

TEST(Explanation, ALostFrameHasNoPoseAndAnUnknownOneNoAnswer) {
  const Map map = two_places();
  const auto lost = explain_frame(map, FrameId(3));
  ASSERT_TRUE(lost);
  EXPECT_FALSE(lost->posed);
  EXPECT_FALSE(lost->covariance);
  EXPECT_FALSE(explain_frame(map, FrameId(4)));
}

}  // namespace explanation_test
}  // namespace placegraph
