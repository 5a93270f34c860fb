#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/measurements/measured_motion.h>
#include <placegraph/pipeline/run.h>
#include <placegraph/pipeline/slam/slam_events.h>

#include <map>
#include <regex>

#include "tests/support/map_bits.h"
#include "tests/support/scenes/street.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace slam_events_test {

using namespace test;

constexpr int kFrames = 24, kDarkBegin = 12, kDarkEnd = 14;

SlamOptions small_options() {
  SlamOptions options;
  options.odometry.points.tracker.max_tracks = 250;
  options.loops.detector.max_features = 400;
  return options;
}

/// The drive, dark for two frames, and then from its 6th frame on again.
const std::vector<Frame>& frames() {
  static const std::vector<Frame> frames = [] {
    const StreetDataset drive(kFrames, kDarkBegin, kDarkEnd);
    std::vector<Frame> all;
    for (int i = 0; i < kFrames + 10; ++i) {
      const int source = i < kFrames ? i : i - kFrames + 6;
      Frame frame = drive.frame(static_cast<std::size_t>(source), Sensor::kStereo);
      frame.id = FrameId(i);
      frame.stamp_ns = 100'000'000LL * i;
      all.push_back(frame);
    }
    return all;
  }();
  return frames;
}

Calibration calibration() { return StreetDataset(1).calibration(Sensor::kStereo); }

/// A letter for each event, and what the events say.
struct Listener final : SlamEvents {
  std::string order;
  std::vector<FrameResult> done;
  std::vector<KeyframeAdded> keyframes;
  std::set<PlaceId> places;
  std::map<PlaceId, SE3> poses;
  std::size_t accepted = 0, refused = 0;
  void frame_posed(const FrameResult& frame) override { order += 'F', done.push_back(frame); }
  void frame_lost(const FrameResult& frame) override { order += 'F', done.push_back(frame); }
  void keyframe_added(const KeyframeAdded& keyframe) override {
    order += 'K', keyframes.push_back(keyframe);
  }
  void loop_accepted(const LoopRecord&) override { order += 'L', ++accepted; }
  void loop_refused(const LoopRecord&) override { order += 'L', ++refused; }
  void place_added(const PlaceAdded& place) override {
    order += 'P';
    EXPECT_TRUE(places.insert(place.place).second);
    poses[place.place] = place.T_map_place;
  }
  void places_merged(const PlacesMerged& merged) override {
    order += 'M';
    EXPECT_TRUE(places.contains(merged.kept));
    EXPECT_EQ(places.erase(merged.gone), 1u);
  }
  void component_joined(const ComponentJoined&) override { order += 'J'; }
  void map_moved(const MapMoved& move) override {
    order += 'V';
    EXPECT_GT(move.places, 0);
    EXPECT_EQ(move.poses.size(), static_cast<std::size_t>(move.places));
    for (const PlacePose& pose : move.poses)
      poses[pose.place] = SE3(pose.S_map_place.rotation(), pose.S_map_place.translation());
  }
};

TEST(SlamEventsOfARun, ComeInTheOrderThatIsSaidAndTellTheWholeMap) {
  Listener listener;
  Slam slam(small_options(), calibration(), {.events = &listener});
  std::vector<FrameResult> results;
  for (const Frame& frame : frames()) results.push_back(slam.add_frame(frame));
  const Map map = slam.finish();

  EXPECT_TRUE(std::regex_match(listener.order, std::regex("(V?(KP*M*J*V?L*P*M*J*V?)*F)*P*M*J*V?")))
      << listener.order;
  ASSERT_EQ(listener.done.size(), frames().size());
  for (std::size_t i = 0; i < results.size(); ++i) {
    EXPECT_EQ(listener.done[i].frame, results[i].frame);
    if (i >= kFrames) continue;
    const bool dark = i >= kDarkBegin && i < kDarkEnd;
    EXPECT_EQ(listener.done[i].T_map_cam.has_value(), !dark) << i;
    EXPECT_EQ(static_cast<bool>(listener.done[i].outcome), !dark) << i;
    EXPECT_EQ(listener.done[i].outcome.reason.empty(), !dark) << i;
  }
  ASSERT_EQ(listener.keyframes.size(), map.keyframes.size());
  for (std::size_t i = 0; i < map.keyframes.size(); ++i) {
    EXPECT_EQ(listener.keyframes[i].keyframe, map.keyframes[i].id);
    EXPECT_EQ(listener.keyframes[i].frame, map.keyframes[i].frame);
  }
  std::set<PlaceId> places;
  for (const Place& place : map.place_graph.places) places.insert(place.id);
  EXPECT_EQ(listener.places, places);
  for (const Place& place : map.place_graph.places)
    EXPECT_EQ(listener.poses.at(place.id).matrix(), place.T_map_place.matrix()) << place.id.value();
  const auto accepted = std::ranges::count_if(map.loops, &LoopRecord::accepted);
  EXPECT_EQ(listener.accepted, static_cast<std::size_t>(accepted));
  EXPECT_GE(listener.accepted + listener.refused, map.loops.size());
}

TEST(SlamEventsOfARun, DoNotChangeIt) {
  Listener listener;
  Slam quiet(small_options(), calibration()),
      watched(small_options(), calibration(), {.events = &listener});
  for (int i = 0; i < 12; ++i) {
    quiet.add_frame(frames()[static_cast<std::size_t>(i)]);
    watched.add_frame(frames()[static_cast<std::size_t>(i)]);
  }
  EXPECT_TRUE(map_bits(quiet.finish()) == map_bits(watched.finish()));
}

TEST(SlamEventsOfARun, SayWhenTheUnitOfLengthIsKnown) {
  struct Units final : SlamEvents {
    void map_moved(const MapMoved& move) override { scaled += move.scale != 1; }
    int scaled = 0;
  } units;
  // Wheels tell the unit once the camera has gone some way.
  const StreetDataset drive(kFrames);
  std::vector<MotionStep> steps;
  for (int i = 0; i + 1 < kFrames; ++i) {
    const SE3 T = street_T_world_cam(i).inverse() * street_T_world_cam(i + 1);
    const auto k = static_cast<std::size_t>(i);
    steps.push_back({drive.stamp_ns(k), drive.stamp_ns(k + 1), T, MotionNoise().covariance(T)});
  }
  SlamOptions options = small_options();
  options.odometry.keyframe.min_tracked_share = 0.85;
  Slam slam(options, drive.calibration(Sensor::kMono),
            {.motion = std::make_shared<const MeasuredMotion>(std::move(steps)), .events = &units});
  for (std::size_t i = 0; i < kFrames; ++i) slam.add_frame(drive.frame(i, Sensor::kMono));
  EXPECT_TRUE(slam.finish().metric);
  EXPECT_GE(units.scaled, 1);
}

TEST(SlamEventsOfARun, GoOnWhereASavedRunIsResumed) {
  const TemporaryFolder folder;
  const StreetDataset drive(16);
  RunOptions options;
  options.sensor = SensorChoice::kStereo;
  options.slam = small_options();
  RunInputs inputs;
  inputs.map_file = {folder / "map.db", "street", false};
  inputs.progress = [](std::size_t done, std::size_t, const FrameResult&) {
    if (done == 12) throw std::runtime_error("interrupted");
  };
  EXPECT_THROW((void)run_sequence(drive, options, inputs), std::runtime_error);

  struct Begun final : SlamEvents {
    void run_began() override { ++begun; }
    void frame_posed(const FrameResult& frame) override { posed.push_back(frame.frame); }
    void place_added(const PlaceAdded& place) override { places.push_back(place.place); }
    int begun = 0;
    std::vector<FrameId> posed;
    std::vector<PlaceId> places;
  } events;
  inputs.progress = {};
  inputs.map_file->resume = true;
  inputs.events = &events;
  const RunResult run = run_sequence(drive, options, inputs);
  ASSERT_TRUE(run.resumed_at);
  EXPECT_EQ(events.begun, 1);
  ASSERT_FALSE(events.posed.empty());
  EXPECT_EQ(events.posed.front(), *run.resumed_at);
  EXPECT_EQ(events.posed.back(), FrameId(15));
  // Places of the saved map are known; new ones have numbers of their own.
  EXPECT_LT(events.places.size(), run.map.place_graph.places.size());
}

TEST(SlamEventsOfARun, EndItIfTheyThrow) {
  struct Thrower final : SlamEvents {
    void keyframe_added(const KeyframeAdded&) override { throw std::runtime_error("enough"); }
  } thrower;
  Slam slam(small_options(), calibration(), {.events = &thrower});
  EXPECT_THROW(slam.add_frame(frames().front()), std::runtime_error);
  EXPECT_THROW(slam.add_frame(frames()[1]), ArgumentError);
  EXPECT_THROW(slam.finish(), ArgumentError);
}

TEST(SnapshotOfARun, IsAValueThatOutlivesIt) {
  std::string bits;
  const Map map = [&] {
    Slam slam(small_options(), calibration());
    for (int i = 0; i < 8; ++i) slam.add_frame(frames()[static_cast<std::size_t>(i)]);
    const Map snapshot = slam.snapshot();
    bits = map_bits(snapshot);
    // What comes after does not reach it.
    for (int i = 8; i < 12; ++i) slam.add_frame(frames()[static_cast<std::size_t>(i)]);
    slam.finish();
    return snapshot;
  }();
  EXPECT_TRUE(map_bits(map) == bits);
  EXPECT_EQ(map.frames.size(), 8u);
}

}  // namespace slam_events_test
}  // namespace placegraph
