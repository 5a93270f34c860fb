#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/pipeline/slam/event_feed.h>

#include "tests/support/place_links.h"

namespace placegraph {
namespace event_feed_test {

using namespace test;
using testing::ElementsAre;
using testing::IsEmpty;

/// What is told, a word and numbers each.
struct RecordedEvents final : SlamEvents {
  std::vector<std::string> message;
  KeyframeAdded keyframe;
  MapMoved move;
  void say(const std::string& word, std::int64_t a, std::int64_t b) {
    message.push_back(word + " " + std::to_string(a) + " " + std::to_string(b));
  }
  void frame_posed(const FrameResult& f) override { say("posed", f.frame.value(), f.inliers); }
  void frame_lost(const FrameResult& f) override { say("lost", f.frame.value(), f.inliers); }
  void keyframe_added(const KeyframeAdded& k) override {
    keyframe = k;
    say("keyframe", k.keyframe.value(), k.frame.value());
  }
  void loop_accepted(const LoopRecord& l) override {
    say("accepted", l.query_frame.value(), l.match_frame.value());
  }
  void loop_refused(const LoopRecord& l) override {
    say("refused", l.query_frame.value(), l.match_frame.value());
  }
  void place_added(const PlaceAdded& p) override {
    say("place", p.place.value(), p.anchor.value());
  }
  void places_merged(const PlacesMerged& p) override {
    say("merged", p.kept.value(), p.gone.value());
  }
  void component_joined(const ComponentJoined& c) override { say("joined", c.component, c.into); }
  void map_moved(const MapMoved& m) override {
    move = m;
    message.push_back("moved");
  }
  /// What was told since the last call.
  std::vector<std::string> news() { return std::exchange(message, {}); }
};

TEST(EventFeed, TellsPlacesOnceAndInTheOrderOfTheirIds) {
  RecordedEvents recorded;
  EventFeed feed(&recorded);
  PlaceMapper mapper = square();
  feed.places_changed(mapper);
  EXPECT_THAT(recorded.news(),
              ElementsAre("place 0 0", "place 1 1", "place 2 2", "place 3 3", "place 4 4"));
  feed.places_changed(mapper);
  EXPECT_THAT(recorded.news(), IsEmpty());
}

TEST(EventFeed, TellsTheLargestMoveOfAPlace) {
  RecordedEvents recorded;
  EventFeed feed(&recorded);
  PlaceMapper mapper = square();
  feed.places_changed(mapper);
  const PlaceGraph before = mapper.place_graph();
  mapper.add_loop(loop(4, 0, SE3(), 0.01, 0.001));
  const PlaceGraph after = optimized(mapper);
  recorded.news();
  feed.places_changed(mapper);
  EXPECT_THAT(recorded.news(), ElementsAre("moved"));
  double translation = 0, rotation = 0;
  int places = 0;
  for (std::size_t i = 0; i < after.places.size(); ++i) {
    const SE3 moved = before.places[i].T_map_place.inverse() * after.places[i].T_map_place;
    translation = std::max(translation, moved.translation().norm());
    rotation = std::max(rotation, moved.rotation().log().norm());
    places += moved.translation().norm() > 0;
  }
  EXPECT_EQ(recorded.move.places, places);
  EXPECT_GT(places, 2);
  EXPECT_NEAR(recorded.move.translation, translation, 1e-12);
  EXPECT_NEAR(recorded.move.rotation_rad, rotation, 1e-12);
  EXPECT_GT(translation, 0.1);
}

TEST(EventFeed, TellsThatTheUnitIsKnownWhereNoPlaceMoves) {
  RecordedEvents recorded;
  EventFeed feed(&recorded);
  PlaceMapper mapper({});
  mapper.add_keyframe(KeyframeId(0), std::nullopt, {}, kDepth_m);
  feed.places_changed(mapper);
  recorded.news();
  mapper.rescale(KeyframeId(0), 2.5);
  feed.places_changed(mapper, 2.5);
  EXPECT_THAT(recorded.news(), ElementsAre("moved"));
  EXPECT_EQ(recorded.move.scale, 2.5);
}

TEST(EventFeed, TellsThatPlacesAreOne) {
  RecordedEvents recorded;
  EventFeed feed(&recorded);
  PlaceMapper mapper = square(true);
  feed.places_changed(mapper);
  recorded.news();
  mapper.add_loop(loop(4, 0, SE3(), 0.01, 0.001));
  optimized(mapper);
  feed.places_changed(mapper);
  EXPECT_THAT(recorded.news(), ElementsAre("merged 0 4", "moved"));
}

TEST(EventFeed, TellsThatASubMapHasJoinedAnother) {
  RecordedEvents recorded;
  EventFeed feed(&recorded);
  PlaceMapper mapper({});
  mapper.add_keyframe(KeyframeId(0), std::nullopt, {}, kDepth_m);
  mapper.add_keyframe(KeyframeId(1), link(0, kLong), {}, kDepth_m);
  mapper.add_keyframe(KeyframeId(2), std::nullopt, {}, kDepth_m);
  feed.places_changed(mapper);
  EXPECT_THAT(recorded.news(), ElementsAre("place 0 0", "place 1 1", "place 2 2"));
  mapper.add_loop(loop(2, 0, kLong * kLong, 0.01, 0.001));
  optimized(mapper);
  feed.places_changed(mapper);
  EXPECT_THAT(recorded.news(), ElementsAre("joined 1 0", "moved"));
}

TEST(EventFeed, TellsThatASubMapHasJoinedAnotherWhereItsOnlyPlaceIsMerged) {
  RecordedEvents recorded;
  EventFeed feed(&recorded);
  PlaceMapper mapper({});
  mapper.add_keyframe(KeyframeId(0), std::nullopt, {}, kDepth_m);
  mapper.add_keyframe(KeyframeId(1), std::nullopt, {}, kDepth_m);
  feed.places_changed(mapper);
  recorded.news();
  mapper.add_loop(loop(1, 0, SE3(), 0.01, 0.001));
  optimized(mapper);
  feed.places_changed(mapper);
  EXPECT_THAT(recorded.news(), ElementsAre("merged 0 1", "joined 1 0"));
}

LoopRecord record(std::int64_t query, std::int64_t match, LoopStage stage) {
  LoopRecord record;
  record.query_frame = FrameId(query);
  record.match_frame = FrameId(match);
  record.stage = stage;
  return record;
}

TEST(EventFeed, TellsALoopThatWaitedForSupportBeforeWhatIsNew) {
  RecordedEvents recorded;
  EventFeed feed(&recorded);
  std::vector<LoopRecord> records = {record(30, 3, LoopStage::kSupport),
                                     record(30, 9, LoopStage::kRetrieval)};
  feed.loops_decided(records);
  EXPECT_THAT(recorded.news(), ElementsAre("refused 30 3", "refused 30 9"));
  records[0].stage = LoopStage::kAccepted;
  records.push_back(record(31, 4, LoopStage::kAccepted));
  feed.loops_decided(records);
  EXPECT_THAT(recorded.news(), ElementsAre("accepted 30 3", "accepted 31 4"));
  feed.loops_decided(records);
  EXPECT_THAT(recorded.news(), IsEmpty());
}

TEST(EventFeed, TellsWhatIsTakenUpNoMore) {
  RecordedEvents recorded;
  EventFeed feed(&recorded);
  PlaceMapper mapper = square();
  const std::vector<LoopRecord> records = {record(30, 3, LoopStage::kAccepted)};
  feed.take_up(mapper, records);
  feed.places_changed(mapper);
  feed.loops_decided(records);
  EXPECT_THAT(recorded.news(), IsEmpty());
}

TEST(EventFeed, TellsFramesByWhetherTheyHaveAPose) {
  RecordedEvents recorded;
  EventFeed feed(&recorded);
  FrameResult frame;
  frame.frame = FrameId(7);
  feed.frame_done(frame);
  frame.T_map_cam = SE3();
  feed.frame_done(frame);
  EXPECT_THAT(recorded.news(), ElementsAre("lost 7 0", "posed 7 0"));
}

TEST(EventFeed, TellsAKeyframeWithItsPlaceAndPose) {
  RecordedEvents recorded;
  EventFeed feed(&recorded);
  const PlaceMapper mapper = square();
  feed.keyframe_added(KeyframeId(5), FrameId(12), mapper);
  EXPECT_THAT(recorded.news(), ElementsAre("keyframe 5 12"));
  EXPECT_EQ(recorded.keyframe.place, mapper.place_of(KeyframeId(4)));  // 5 hangs on the place of 4
  const SE3 off = recorded.keyframe.T_map_cam.inverse() * mapper.T_map_keyframe(KeyframeId(5));
  EXPECT_EQ(off.translation().norm(), 0);
}

TEST(EventFeed, LooksAtNothingWithoutAListener) {
  RecordedEvents recorded;
  const PlaceMapper empty({});  // a keyframe that it does not know is an error where it is told
  EXPECT_THROW(EventFeed(&recorded).keyframe_added(KeyframeId(0), FrameId(0), empty),
               std::out_of_range);
  EXPECT_NO_THROW(EventFeed(nullptr).keyframe_added(KeyframeId(0), FrameId(0), empty));
}

}  // namespace event_feed_test
}  // namespace placegraph
