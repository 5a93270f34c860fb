#include "apps/map/queries/explain.h"

#include <gtest/gtest.h>

#include <cmath>

#include "apps/support/output.h"
#include "tests/support/clean_world.h"
#include "tests/support/message_of.h"
#include "tests/support/random_map.h"
#include "tests/support/scenes/street_files.h"
#include "tests/unit/apps/map/posed_map.h"

namespace placegraph::apps {
namespace explain_test {

using nlohmann::json;
using test::message_of;
using testing::HasSubstr;

/// Two places a metre apart along z, of a camera 1.65 m above the ground; frame 2 is half a metre
/// beyond the second, frame 3 is lost; of two loops one was refused.
StoredMap two_places() {
  StoredMap stored;
  stored.origin.sequence = "/nowhere/street";
  Calibration& calibration = stored.origin.calibration.emplace();
  calibration.camera = {448, 280, 330, 330, 223.5, 139.5, Distortion::kNone, {}};
  calibration.camera_height_m = 1.65;
  Map& map = stored.map;
  map.metric = true;
  const auto at_z = [](double z) { return SE3(SO3(), Eigen::Vector3d(0, 0, z)); };
  for (int k = 0; k < 2; ++k) {
    Keyframe keyframe;
    keyframe.id = KeyframeId(k);
    keyframe.place = PlaceId(k);
    keyframe.frame = FrameId(k);
    keyframe.stamp_ns = 100 * k;
    keyframe.features.resize(5);
    map.keyframes.push_back(keyframe);
    Place place;
    place.id = PlaceId(k);
    place.anchor_keyframe = KeyframeId(k);
    place.T_map_place = at_z(k);
    place.members = {{KeyframeId(k), SE3(), 1}};
    if (k == 1) place.labels = {"corridor", "environment:corridor"};
    map.place_graph.places.push_back(place);
  }
  RelativePoseConstraint edge;
  edge.from = NodeId(0), edge.to = NodeId(1);
  edge.T_from_to = at_z(1);
  edge.information = 100 * Matrix6d::Identity();
  map.place_graph.constraints.push_back(edge);
  map.frames = {{FrameId(0), 0, KeyframeId(0), SE3(), 20},
                {FrameId(1), 100, KeyframeId(1), SE3(), 30},
                {FrameId(2), 1'500'000'000, KeyframeId(1), at_z(0.5), 40},
                {FrameId(3), 2'000'000'000, std::nullopt, std::nullopt, 0}};
  for (const FrameRecord& frame : map.frames)
    map.trajectory_online.poses.push_back({frame.stamp_ns, std::nullopt});
  LoopRecord accepted, refused;
  accepted.query_frame = FrameId(1), accepted.match_frame = FrameId(0), accepted.inliers = 33;
  accepted.stage = LoopStage::kAccepted;
  refused.query_frame = FrameId(1), refused.match_frame = FrameId(0),
  refused.stage = LoopStage::kGeometry;
  map.loops = {accepted, refused};
  return stored;
}

class ExplainTwoPlaces : public testing::Test {
 protected:
  json explained(std::int64_t frame) {
    write_map(folder / "map.db", stored);
    return explain({folder.path(), FrameId(frame)}).explanation;
  }
  test::TemporaryFolder folder;
  StoredMap stored = two_places();
};

TEST_F(ExplainTwoPlaces, SaysWhereAFrameIsAndHowThatIsKnown) {
  const json frame = explained(2);
  EXPECT_EQ(frame["stamp_s"], 1.5);
  const json& where = frame["where"];
  EXPECT_EQ(where["place"], 1);
  EXPECT_EQ(where["unit"], "m");
  EXPECT_NEAR(where["position"][2].get<double>(), 1.5, 1e-12);
  EXPECT_NEAR(where["distance_to_keyframe"].get<double>(), 0.5, 1e-12);
  // An edge of 0.1 in every direction; half a metre ahead its turn moves the frame sideways too:
  // 0.01 each, and twice 0.5^2 0.01.
  EXPECT_NEAR(where["sigma_position"].get<double>(), std::sqrt(0.03 + 0.005), 1e-9);
  EXPECT_EQ(frame["known_by"]["inliers"], 40);
  EXPECT_EQ(frame["known_by"]["features"], 5);
  EXPECT_EQ(frame["known_by"]["constraints"], json({{"odometry", 1}}));
  ASSERT_EQ(frame["known_by"]["loops"].size(), 1u);
  EXPECT_EQ(frame["known_by"]["loops"][0]["inliers"], 33);
  ASSERT_EQ(frame["refused"].size(), 1u);
  EXPECT_EQ(frame["refused"][0]["stage"], to_string(LoopStage::kGeometry));
}

TEST_F(ExplainTwoPlaces, SaysWhatWasTakenForGranted) {
  const json assumed = explained(2)["assumed"];
  EXPECT_EQ(assumed["sensor"], "monocular");
  EXPECT_EQ(assumed["ground_below_camera_m"], 1.65);
  EXPECT_EQ(assumed["environment"]["kind"], "corridor");
  EXPECT_FALSE(explained(0)["assumed"].contains("environment"));
  stored.origin.calibration->baseline_m = 0.5;
  EXPECT_EQ(explained(2)["assumed"]["sensor"], "measured depth");
}

TEST_F(ExplainTwoPlaces, CountsInUnitsWhereTheScaleIsUnknown) {
  write_map(folder / "map.db", stored);
  EXPECT_THAT(to_text(explain({folder.path(), FrameId(2)})),
              testing::AllOf(HasSubstr("0.5 m from its keyframe 1"), HasSubstr(" m and ")));
  stored.map.metric = false;
  write_map(folder / "map.db", stored);
  const std::string text = to_text(explain({folder.path(), FrameId(2)}));
  EXPECT_THAT(text,
              testing::AllOf(HasSubstr("0.5 units from its keyframe 1"),
                             HasSubstr("position 0 0 1.5 units, "), HasSubstr(" units and ")));
}

TEST_F(ExplainTwoPlaces, ALostFrameHasNoPlace) {
  EXPECT_EQ(explained(3)["where"], json({{"posed", false}}));
}

TEST_F(ExplainTwoPlaces, SaysWhatThePictureShowsWhereThatIsStillThere) {
  EXPECT_EQ(explained(1)["sees"],
            json({{"unknown", "the images are no longer at /nowhere/street"}}));
  test::StreetFiles(folder, 2).write_kitti(false);
  stored.origin.sequence = folder / "s";
  const json sees = explained(1)["sees"];
  for (const char* kind : {"surfaces", "classes"}) {
    double sum = 0;
    for (const auto& [name, share] : sees[kind].items()) sum += share.get<double>();
    EXPECT_NEAR(sum, 1, 1e-9) << kind;
  }
  EXPECT_EQ(explained(2)["sees"]["unknown"], (folder / "s") + " has 2 frames now");
  EXPECT_EQ(sees["street"], 0.0);  // the run called the place a corridor
  EXPECT_EQ(sees["classes"], json({{"none", 1.0}}));
}

/// What `explain` tells of the image of frame 8 of a rendered world, by its map at true poses.
json seen_in_world(const std::string& name, Sensor sensor, int width, int height) {
  const test::TemporaryFolder folder;
  const SyntheticWorld world(test::clean_world(name, 12, width, height));
  SequenceWriterOptions writing;
  writing.contents.right = sensor == Sensor::kStereo;
  writing.contents.depth = sensor == Sensor::kRgbd;
  write_sequence(world, folder / "world", writing);
  write_map(folder / "map.db", test::posed_map(world, folder / "world", sensor, 2));
  return explain({folder / "map.db", FrameId(8)}).explanation["sees"];
}

TEST(ExplainCommand, TellsNoStreetClassesOfACorridor) {
  const json sees = seen_in_world("corridor-loop", Sensor::kRgbd, 320, 240);
  EXPECT_LT(sees["street"].get<double>(), 0.2);
  EXPECT_GE(sees["classes"]["none"].get<double>(), 0.95);
}

TEST(ExplainCommand, TellsTheClassesOfAStreet) {
  const json sees = seen_in_world("town-loop", Sensor::kStereo, 620, 188);
  EXPECT_GT(sees["street"].get<double>(), 0.5);
  EXPECT_LT(sees["classes"].value("none", 0.0), 0.5);
  EXPECT_TRUE(sees["classes"].contains("Road"));
}

TEST(ExplainCommand, RefusesAFrameThatTheMapDoesNotHave) {
  const test::TemporaryFolder folder;
  Random random(3);
  const StoredMap stored = test::random_map(random);
  write_map(folder / "map.db", stored);
  ExplainArguments arguments;
  arguments.map = folder / "map.db";
  arguments.frame = FrameId(1'000'000);
  EXPECT_THAT(message_of<NoResult>([&] { explain(arguments); }),
              HasSubstr("map.db: has no frame 1000000"));
}

TEST(ExplainText, SaysWhatIsKnownLineByLine) {
  ExplainResult result;
  result.explanation = {{"frame", 7},
                        {"stamp_s", 1.5},
                        {"where", {{"posed", false}}},
                        {"known_by",
                         {{"inliers", 3},
                          {"features", 20},
                          {"features_placed", 5},
                          {"constraints", {{"odometry", 1}}},
                          {"loops", json::array()}}},
                        {"sees", {{"unknown", "no model"}}},
                        {"assumed",
                         {{"sensor", "monocular"},
                          {"cues", "points"},
                          {"metric", true},
                          {"ground_below_camera_m", 1.65}}},
                        {"refused", json::array()}};
  EXPECT_EQ(to_text(result),
            "frame      7, 1.500 s\n"
            "where      not posed: tracking was lost or not yet initialized\n"
            "known by   3 landmarks; keyframe with 20 features, 5 placed; constraints "
            "{\"odometry\":1}\n"
            "sees       unknown: no model\n"
            "assumed    monocular, cues points, ground 1.65 m below the camera, metric\n"
            "refused    nothing\n");
  EXPECT_EQ(json::parse(to_json(result)), result.explanation);
}

}  // namespace explain_test
}  // namespace placegraph::apps
