#include <gtest/gtest.h>
#include <placegraph/graph/image/jpeg_codec.h>
#include <placegraph/pipeline/slam/map_feed.h>

#include "tests/support/scenes/street.h"

namespace placegraph {
namespace map_feed_test {

using namespace test;

const StreetDataset& drive() {
  static const StreetDataset dataset(6);
  return dataset;
}

/// The parts of a stereo run along the street, every frame of it a keyframe.
struct System {
  Calibration calibration = drive().calibration(Sensor::kStereo);
  StageTimes times;
  Odometry odometry{every_frame(), calibration, 1, {}, times};
  LoopCloser closer{{}, calibration, 1};
  PlaceMapper mapper{PlaceOptions{}};
  TrajectoryRecorder recorder;
  EnvironmentMonitor environments{{}, calibration.camera};
  MapFeed feed{{}};
  int next = 0;

  System() { odometry.restart(SE3()); }
  static OdometryOptions every_frame() {
    OdometryOptions options;
    options.cues = "points";
    options.keyframe.max_interval = 1;
    return options;
  }
  MapSources sources() { return {odometry, closer, mapper, recorder, environments}; }
  /// A frame as Slam takes it; `colour`: whether it has any.
  void add(bool colour = false) {
    Frame frame = drive().frame(static_cast<std::size_t>(next++), Sensor::kStereo);
    if (colour) frame.colour = Image(frame.image.size(), CV_8UC3, cv::Scalar(20, 90, 160));
    recorder.begin(frame);
    const OdometryUpdate update = odometry.add_frame(frame);
    ASSERT_EQ(update.state, TrackingState::kTracking);
    ASSERT_EQ(update.new_keyframes.size(), 1u);
    const KeyframeId id = update.new_keyframes[0].id;
    recorder.add_keyframe(update.new_keyframes[0]);
    std::optional<SE3> T_previous_this;
    std::optional<PlaceMapper::Link> link;
    if (id > KeyframeId(0)) {
      T_previous_this =
          odometry.map().pose(KeyframeId(id.value() - 1)).inverse() * odometry.map().pose(id);
      link = PlaceMapper::Link{KeyframeId(id.value() - 1), *T_previous_this,
                               100 * Matrix6d::Identity()};
    }
    closer.add_view(id, frame, T_previous_this);
    mapper.add_keyframe(id, link, SE3(), odometry.map().median_depth());
    recorder.record(id, SE3(), update.inliers);
    recorder.finish(update.T_odom_cam, 0);
    feed.keep_view(id, frame, odometry.map());
  }
};

TEST(MapFeed, ASnapshotHoldsEveryPart) {
  System run;
  for (int i = 0; i < 3; ++i) run.add();
  const Map map = run.feed.snapshot(run.sources());
  ASSERT_EQ(map.keyframes.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(map.keyframes[k].id, KeyframeId(k));
    EXPECT_EQ(map.keyframes[k].frame, FrameId(k));
    EXPECT_EQ(map.keyframes[k].stamp_ns, drive().stamp_ns(k));
    EXPECT_FALSE(map.keyframes[k].features.empty());
    EXPECT_FALSE(map.keyframes[k].view.empty());
    // Its pose by place and member is that of the odometry, whose frame is the map's here.
    const Sim3 S = map.S_map_keyframe(KeyframeId(k));
    EXPECT_LT((S.translation() -
               run.odometry.map().pose(KeyframeId(static_cast<std::int64_t>(k))).translation())
                  .norm(),
              0.05);
  }
  EXPECT_EQ(map.frames.size(), 3u);
  EXPECT_EQ(map.trajectory_online.poses.size(), 3u);
  EXPECT_EQ(map.landmarks.size(), run.odometry.map().landmarks().size());
  EXPECT_TRUE(map.metric);
}

TEST(MapFeed, ASnapshotTellsNothing) {
  System run;
  run.add();
  (void)run.feed.snapshot(run.sources());
  EXPECT_EQ(run.feed.take_changes(run.sources()).keyframes.size(), 1u);
}

TEST(MapFeed, ChangesAreTheNewFramesAndKeyframes) {
  System run;
  for (int i = 0; i < 3; ++i) run.add();
  const MapChanges all = run.feed.take_changes(run.sources());
  EXPECT_EQ(all.keyframes.size(), 3u);
  EXPECT_EQ(all.first_frame, 0u);
  EXPECT_EQ(all.frames.size(), 3u);
  EXPECT_EQ(all.online.size(), 3u);
  EXPECT_EQ(all.appearances.size(), all.places.size());
  EXPECT_EQ(all.history.median_depth_m, run.odometry.map().median_depth());
  run.add();
  const MapChanges more = run.feed.take_changes(run.sources());
  // The last keyframe is told again: its successor gives depth to its features.
  ASSERT_EQ(more.keyframes.size(), 2u);
  EXPECT_EQ(more.keyframes[0].id, KeyframeId(2));
  EXPECT_EQ(more.keyframes[1].id, KeyframeId(3));
  EXPECT_TRUE(more.keyframes[0].view.empty());  // how it looks is known
  EXPECT_FALSE(more.keyframes[1].view.empty());
  EXPECT_EQ(more.first_frame, 3u);
  EXPECT_EQ(more.frames.size(), 1u);
  EXPECT_EQ(more.online.size(), 1u);
}

TEST(MapFeed, KeepsThumbnailsObservationsAndColours) {
  System run;
  for (int i = 0; i < 3; ++i) run.add(true);
  const Map map = run.feed.snapshot(run.sources());
  for (const Keyframe& keyframe : map.keyframes) {
    const Image thumbnail = decode_jpeg(keyframe.thumbnail);
    ASSERT_EQ(thumbnail.type(), CV_8UC3);
    EXPECT_EQ(std::max(thumbnail.cols, thumbnail.rows), 160);
    EXPECT_GT(keyframe.observations.size(), 20u);
  }
  for (const PointLandmark& landmark : map.landmarks) {
    ASSERT_TRUE(landmark.rgb);
    EXPECT_EQ(*landmark.rgb, (std::array<std::uint8_t, 3>{160, 90, 20}));
  }
  const MapChanges all = run.feed.take_changes(run.sources());
  ASSERT_EQ(all.observations.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(all.observations[k].first, map.keyframes[k].id);
    EXPECT_EQ(all.observations[k].second.size(), map.keyframes[k].observations.size());
  }
  EXPECT_EQ(all.keyframes[0].thumbnail, map.keyframes[0].thumbnail);
  run.add(true);
  const MapChanges more = run.feed.take_changes(run.sources());
  EXPECT_TRUE(more.keyframes[0].thumbnail.empty());  // it is known
  EXPECT_FALSE(more.keyframes[1].thumbnail.empty());
  EXPECT_EQ(more.observations.back().first, KeyframeId(3));
}

TEST(MapFeed, NothingNewIsTheLastKeyframeAlone) {
  System run;
  run.add();
  (void)run.feed.take_changes(run.sources());
  const MapChanges nothing = run.feed.take_changes(run.sources());
  EXPECT_EQ(nothing.keyframes.size(), 1u);
  EXPECT_TRUE(nothing.frames.empty());
  EXPECT_TRUE(nothing.appearances.empty());
  EXPECT_TRUE(nothing.constraints.empty());
}

TEST(MapFeed, AChangeOfScaleTellsAllKeyframesAgain) {
  System run;
  for (int i = 0; i < 3; ++i) run.add();
  (void)run.feed.take_changes(run.sources());
  run.feed.report_again();
  const MapChanges again = run.feed.take_changes(run.sources());
  EXPECT_EQ(again.keyframes.size(), 3u);
  EXPECT_EQ(again.first_landmark, 0u);
  EXPECT_EQ(again.landmarks.size(), run.odometry.map().landmarks().size());
}

TEST(MapFeed, ViewsAreInColourIfTheFirstIs) {
  System grey, coloured, mixed;
  grey.add(false), grey.add(true);
  coloured.add(true), coloured.add(true);
  mixed.add(true), mixed.add(false);
  const auto views = [](System& run) { return run.feed.take_changes(run.sources()).keyframes; };
  for (const Keyframe& keyframe : views(grey)) {
    EXPECT_FALSE(keyframe.view.empty());
    EXPECT_TRUE(keyframe.view.colour.empty());
  }
  for (const Keyframe& keyframe : views(coloured)) EXPECT_FALSE(keyframe.view.colour.empty());
  const auto of_mixed = views(mixed);
  EXPECT_FALSE(of_mixed[0].view.colour.empty());
  EXPECT_TRUE(of_mixed[1].view.empty());  // grey and coloured views cannot be compared
}

/// A map of two landmarks, one place and the view of one keyframe.
Map earlier_map() {
  Map map;
  map.landmarks = {{LandmarkId(4), KeyframeId(0), Eigen::Vector3d(0, 0, 1), 3},
                   {LandmarkId(9), KeyframeId(0), Eigen::Vector3d(0, 0, 2), 3}};
  Keyframe keyframe;
  keyframe.view = describe_place(Image(120, 160, CV_8UC3, cv::Scalar(9, 99, 200)), {}, false);
  map.keyframes.push_back(keyframe);
  map.place_graph.places.emplace_back();
  return map;
}

TEST(MapFeed, LandmarksOfATakenUpMapComeFirstAndIdsGoOn) {
  System run;
  run.feed.take_up(earlier_map(), run.closer);
  run.add();
  const Map map = run.feed.snapshot(run.sources());
  ASSERT_EQ(map.landmarks.size(), run.odometry.map().landmarks().size() + 2);
  EXPECT_EQ(map.landmarks[0].id, LandmarkId(4));
  EXPECT_EQ(map.landmarks[1].id, LandmarkId(9));
  for (std::size_t i = 2; i < map.landmarks.size(); ++i)
    EXPECT_EQ(map.landmarks[i].id.value(), run.odometry.map().landmarks()[i - 2].id.value() + 10);
}

TEST(MapFeed, AResumedMapIsNotReportedAgain) {
  System run;
  run.feed.take_up(earlier_map(), run.closer);
  run.add(true);
  run.add(true);
  const MapChanges changes = run.feed.take_changes(run.sources());
  // Its one keyframe and its place, number 0 here as well, are known.
  ASSERT_EQ(changes.keyframes.size(), 1u);
  EXPECT_EQ(changes.keyframes[0].id, KeyframeId(1));
  ASSERT_EQ(changes.places.size(), 1u);
  EXPECT_EQ(changes.places[0].id, PlaceId(0));
  EXPECT_TRUE(changes.appearances.empty());
}

TEST(MapFeed, ATakenUpMapSaysWhetherViewsHaveColour) {
  System run;
  run.feed.take_up(earlier_map(), run.closer);  // in colour
  run.add(false);
  run.add(true);
  const MapChanges changes = run.feed.take_changes(run.sources());
  EXPECT_FALSE(changes.keyframes.back().view.colour.empty());
  run.add(false);
  EXPECT_TRUE(run.feed.take_changes(run.sources()).keyframes.back().view.empty());
}

}  // namespace map_feed_test
}  // namespace placegraph
