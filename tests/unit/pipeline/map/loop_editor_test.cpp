#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/pipeline/map/loop_editor.h>

#include "tests/support/message_of.h"
#include "tests/support/place_links.h"

namespace placegraph {
namespace loop_editor_test {

using namespace test;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr int kFeatures = 60;

Camera camera() {
  Camera camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = camera.fy = 400;
  camera.cx = 320;
  camera.cy = 240;
  return camera;
}

BinaryDescriptor random_descriptor(Random& random) {
  BinaryDescriptor descriptor;
  for (std::uint64_t& word : descriptor)
    word = static_cast<std::uint64_t>(random.next()) << 32 | random.next();
  return descriptor;
}

/// What a keyframe at the origin sees of a box of points; `seed`: the appearance of the points.
std::vector<Feature> features(std::uint64_t seed, const SE3& T_cam_world = {}) {
  Random random(seed);
  std::vector<Feature> result;
  for (int i = 0; i < kFeatures; ++i) {
    const Eigen::Vector3d point =
        T_cam_world *
        Eigen::Vector3d(random.uniform(-4, 4), random.uniform(-3, 3), random.uniform(5, 15));
    Feature& feature = result.emplace_back();
    feature.px = camera().project(point)->cast<float>();
    feature.point_cam = point.cast<float>();
    feature.descriptor = random_descriptor(random);
  }
  return result;
}

/// A map of the square, whose keyframes 0 and 4 show the same points; keyframe k is frame 10 k.
StoredMap map_of(PlaceMapper& mapper) {
  (void)optimized(mapper);
  StoredMap stored;
  stored.origin.calibration.emplace();
  stored.origin.calibration->camera = camera();
  stored.history = mapper.history();
  Map& map = stored.map;
  map.place_graph = mapper.place_graph();
  map.metric = mapper.metric();
  for (const Place& place : map.place_graph.places)
    for (const PlaceMember& member : place.members) {
      Keyframe keyframe;
      keyframe.id = member.keyframe;
      keyframe.frame = FrameId(10 * member.keyframe.value());
      keyframe.place = place.id;
      keyframe.T_place_keyframe = member.T_place_keyframe;
      keyframe.features = member.keyframe == KeyframeId(4)
                              ? features(0)
                              : features(static_cast<std::uint64_t>(member.keyframe.value()));
      map.keyframes.push_back(keyframe);
    }
  std::ranges::sort(map.keyframes, {}, &Keyframe::id);
  for (const Keyframe& keyframe : map.keyframes) {
    FrameRecord& frame = map.frames.emplace_back();
    frame.frame = keyframe.frame;
    frame.keyframe = keyframe.id;
    frame.T_keyframe_frame = SE3();
  }
  for (const Loop& loop : stored.history.loops) {
    LoopRecord& record = map.loops.emplace_back();
    record.query_frame = FrameId(10 * loop.query.value());
    record.match_frame = FrameId(10 * loop.match.value());
    record.stage = LoopStage::kAccepted;
    record.T_match_query = loop.T_match_query;
  }
  return stored;
}

SlamOptions options(bool merge = false) {
  SlamOptions options;
  options.places.merge = merge;
  options.loops.database.first_training = 4;
  return options;
}

Eigen::Vector3d position(const StoredMap& stored, int keyframe) {
  return stored.map.S_map_keyframe(KeyframeId(keyframe)).translation();
}

/// The square with a loop that is 3 m wrong, and moves the map as far as its robust kernel allows.
StoredMap with_wrong_loop() {
  PlaceMapper mapper = square();
  mapper.add_loop(loop(4, 0, pose({0, 0, 0}, {3, 0, 0}), 0.01, 0.001));
  return map_of(mapper);
}

TEST(LoopEditor, RefusingALoopGivesTheMapOfOdometry) {
  PlaceMapper odometry = square();
  const StoredMap without = map_of(odometry);
  LoopEditor editor(with_wrong_loop(), options());
  ASSERT_GT((position(editor.stored(), 4) - position(without, 4)).norm(), 0.2);
  EXPECT_EQ(editor.refuse(FrameId(40), FrameId(0)), "refused the loop of frames 40 and 0");
  EXPECT_FALSE(editor.optimized());
  EXPECT_EQ(editor.stored().map.loops.at(0).stage, LoopStage::kManual);
  EXPECT_TRUE(editor.stored().history.loops.empty());
  for (const RelativePoseConstraint& constraint : editor.stored().map.place_graph.constraints)
    EXPECT_NE(constraint.source, ConstraintSource::kLoop);
  const MapMotion motion = editor.optimize();
  EXPECT_TRUE(editor.optimized());
  EXPECT_GT(motion.translation, 0.2);
  for (int k = 0; k <= 5; ++k)
    EXPECT_LT((position(editor.stored(), k) - position(without, k)).norm(), 1e-3) << k;
}

// A judgement of the run is not one of the edited map, but what it doubts stays in doubt.
TEST(LoopEditor, MetresThatAreWithdrawnStayWithdrawn) {
  for (const bool withdrawn : {false, true}) {
    StoredMap stored = with_wrong_loop();
    ASSERT_TRUE(stored.map.metric);
    stored.map.metric = !withdrawn;
    for (const int edit : {0, 1}) {  // of the map of a run, and of a map that was edited
      LoopEditor editor(stored, options());
      edit == 0 ? editor.refuse(FrameId(40), FrameId(0)) : editor.add(FrameId(40), FrameId(0));
      editor.optimize();
      EXPECT_EQ(editor.stored().map.metric, !withdrawn) << edit;
      EXPECT_FALSE(editor.stored().judgement);
      stored = editor.stored();
    }
  }
}

TEST(LoopEditor, AddsALoopWhereTheImagesAgree) {
  PlaceMapper odometry = square();
  LoopEditor editor(map_of(odometry), options());
  ASSERT_GT(position(editor.stored(), 4).norm(), 0.3);
  EXPECT_THAT(editor.add(FrameId(0), FrameId(40)), HasSubstr("added the loop of frames 40 and 0"));
  (void)editor.optimize();
  EXPECT_LT(position(editor.stored(), 4).norm(), 0.1);
  const LoopRecord& record = editor.stored().map.loops.at(0);
  EXPECT_TRUE(record.accepted());
  EXPECT_EQ(record.query_frame, FrameId(40));
  EXPECT_GE(record.inliers, kFeatures / 2);
  EXPECT_GT(record.probability, 0.9);
}

TEST(LoopEditor, TakesNoLoopWhoseImagesDisagree) {
  PlaceMapper odometry = square();
  LoopEditor editor(map_of(odometry), options());
  EXPECT_THAT(message_of<ArgumentError>([&] { (void)editor.add(FrameId(30), FrameId(10)); }),
              HasSubstr("agree with no relative pose"));
  EXPECT_TRUE(editor.edits().empty());
  EXPECT_TRUE(editor.stored().map.loops.empty());
}

TEST(LoopEditor, AcceptsARefusedLoopAgain) {
  PlaceMapper mapper = square();
  mapper.add_loop(loop(4, 0, SE3(), 0.01, 0.001));
  LoopEditor editor(map_of(mapper), options());
  const Eigen::Vector3d before = position(editor.stored(), 4);
  (void)editor.refuse(FrameId(40), FrameId(0));
  (void)editor.optimize();
  ASSERT_GT((position(editor.stored(), 4) - before).norm(), 0.3);
  (void)editor.accept(FrameId(40), FrameId(0));
  (void)editor.optimize();
  EXPECT_LT((position(editor.stored(), 4) - before).norm(), 0.1);
  ASSERT_EQ(editor.stored().map.loops.size(), 1u);
  EXPECT_TRUE(editor.stored().map.loops[0].accepted());
}

TEST(LoopEditor, SeparatesThePlacesThatALoopHadMerged) {
  PlaceMapper mapper = square(true);
  mapper.add_loop(loop(4, 0, SE3(), 0.01, 0.001));
  StoredMap stored = map_of(mapper);
  stored.map.place_graph.places[0].labels = {"hall"};
  LoopEditor editor(stored, options(true));
  ASSERT_EQ(editor.stored().map.keyframes[0].place, editor.stored().map.keyframes[4].place);
  (void)editor.refuse(FrameId(40), FrameId(0));
  const MapMotion motion = editor.optimize();
  EXPECT_EQ(motion.places_after, motion.places_before + 1);
  const Map& map = editor.stored().map;
  EXPECT_NE(map.keyframes[0].place, map.keyframes[4].place);
  EXPECT_GT(position(editor.stored(), 4).norm(), 0.3);
  // The new place was part of the labelled one, and both have words of one vocabulary.
  for (const int keyframe : {0, 4}) {
    const Place& place = *map.place_graph.find(map.keyframes[keyframe].place);
    EXPECT_THAT(place.labels, ElementsAre("hall"));
    EXPECT_FALSE(place.appearance.words.empty());
  }
}

TEST(LoopEditor, PartsComponentsThatALoopHadJoined) {
  PlaceMapper mapper{PlaceOptions()};
  mapper.add_keyframe(KeyframeId(0), std::nullopt, {}, kDepth_m);
  mapper.add_keyframe(KeyframeId(1), link(0, kLong), {}, kDepth_m);
  mapper.add_keyframe(KeyframeId(2), std::nullopt, pose({0, 1, 0}, {50, 0, 0}), kDepth_m);
  mapper.add_keyframe(KeyframeId(3), link(2, kLong), {}, kDepth_m);
  mapper.add_loop(loop(3, 1, pose({0, -0.1, 0}, {4, 0, 4}), 0.02, 0.002));
  LoopEditor editor(map_of(mapper), options());
  ASSERT_EQ(editor.stored().map.components().size(), 1u);
  (void)editor.refuse(FrameId(30), FrameId(10));
  EXPECT_EQ(editor.optimize().components_after, 2u);
  EXPECT_EQ(editor.stored().map.components().size(), 2u);
}

TEST(LoopEditor, TakesBackEditsOneByOne) {
  LoopEditor editor(with_wrong_loop(), options());
  const Eigen::Vector3d before = position(editor.stored(), 4);
  (void)editor.refuse(FrameId(40), FrameId(0));
  (void)editor.optimize();
  EXPECT_EQ(editor.edits().size(), 2u);
  EXPECT_TRUE(editor.undo());
  EXPECT_FALSE(editor.optimized());
  EXPECT_EQ(position(editor.stored(), 4), before);
  EXPECT_TRUE(editor.undo());
  EXPECT_TRUE(editor.stored().map.loops[0].accepted());
  EXPECT_TRUE(editor.edits().empty());
  EXPECT_FALSE(editor.undo());
}

TEST(LoopEditor, SaysWhyAnEditCannotBeMade) {
  LoopEditor editor(with_wrong_loop(), options());
  const auto refusal = [&](int query, int match) {
    return message_of<ArgumentError>([&] { (void)editor.refuse(FrameId(query), FrameId(match)); });
  };
  EXPECT_EQ(refusal(30, 0), "the map has no accepted loop of frames 30 and 0");
  EXPECT_EQ(message_of<ArgumentError>([&] { (void)editor.accept(FrameId(40), FrameId(0)); }),
            "the loop of frames 40 and 0 is in the map already");
  EXPECT_EQ(message_of<ArgumentError>([&] { (void)editor.accept(FrameId(30), FrameId(0)); }),
            "the map has no candidate of frames 30 and 0");
  EXPECT_EQ(message_of<ArgumentError>([&] { (void)editor.add(FrameId(999), FrameId(0)); }),
            "the map has no frame 999");
  EXPECT_EQ(message_of<ArgumentError>([&] { (void)editor.add(FrameId(10), FrameId(10)); }),
            "frames 10 and 10 have one keyframe, which needs no loop");
  StoredMap imported = with_wrong_loop();
  imported.history = {};
  EXPECT_THAT(message_of<ArgumentError>([&] { LoopEditor(imported, options()); }),
              HasSubstr("imported"));
}

}  // namespace loop_editor_test
}  // namespace placegraph
