#include <gtest/gtest.h>
#include <placegraph/pipeline/cues/point_cue.h>
#include <placegraph/pipeline/tracking/feature_tracker.h>

#include <algorithm>

#include "tests/support/scenes/street.h"

namespace placegraph {
namespace feature_tracker_test {

using namespace test;

const StreetDataset& stereo_drive() {
  static const StreetDataset dataset(5);
  return dataset;
}
const StreetDataset& depth_drive() {
  static const StreetDataset dataset(3, 0, 0, true);
  return dataset;
}
double error(const SE3& a, const SE3& b) { return (a.inverse() * b).log().norm(); }

struct Tracking {
  Sensor sensor;
  const StreetDataset& dataset;
  StageTimes times;
  OdometryOptions options;
  Calibration calibration;
  FeatureTracker tracker;
  LocalMap map;
  MotionModel motion{street_T_world_cam(0)};

  explicit Tracking(Sensor s = Sensor::kStereo, const std::string& cues = "points",
                    double max_flow_share = KeyframeOptions().max_flow_share,
                    int min_inliers = Pose3d2dOptions().ransac.min_inliers)
      : sensor(s),
        dataset(s == Sensor::kRgbd ? depth_drive() : stereo_drive()),
        options(named(cues, max_flow_share, min_inliers)),
        calibration(dataset.calibration(s)),
        tracker(options, calibration, 1, {}, times),
        map(options.window, calibration.camera,
            s == Sensor::kMono ? Scale::kArbitrary : Scale::kMetric) {}
  static OdometryOptions named(const std::string& cues, double max_flow_share, int min_inliers) {
    OdometryOptions options;
    options.cues = cues;
    options.keyframe.max_flow_share = max_flow_share;
    options.points.pose.ransac.min_inliers = min_inliers;
    return options;
  }
  KeyframeImages images(int i) const {
    const Frame frame = dataset.frame(i, sensor);
    return {frame, frame.mask, nullptr};
  }
  /// As LocalMapping does; returns the frames that are posed once more.
  std::vector<PosedFrame> keyframe(int i, const SE3& T_odom_cam) {
    if (map.empty()) tracker.see_first(dataset.frame(i, sensor));
    const auto T = tracker.prepare_keyframe(images(i), T_odom_cam, map);
    EXPECT_TRUE(T);
    map.add_keyframe(*T);
    tracker.observe(images(i), {}, map);
    (void)map.optimize();
    map.update_poses(tracker.prune(map), tracker.corrects_rotations());
    tracker.settle(map);
    return tracker.finish_keyframe(1, map);
  }
  TrackedFrame track(int i) {
    TrackedFrame tracked = tracker.track(dataset.frame(i, sensor), map, motion);
    if (tracked.outcome) motion.update(tracked.T_odom_cam);
    return tracked;
  }
  TrackedFrame track_dark() {
    Frame dark = dataset.frame(1, sensor);
    dark.image = Image(dark.image.size(), CV_8UC1, cv::Scalar(0));
    return tracker.track(dark, map, motion);
  }
};

TEST(FeatureTracker, PosesFramesByThePointsOfAStereoKeyframe) {
  Tracking t;
  (void)t.keyframe(0, street_T_world_cam(0));
  EXPECT_GT(t.map.landmarks_in_window(), 100);
  for (int i = 1; i < 4; ++i) {
    const TrackedFrame tracked = t.track(i);
    ASSERT_TRUE(tracked.outcome) << i << tracked.outcome.reason;
    EXPECT_LT(error(tracked.T_odom_cam, street_T_world_cam(i)), 0.03) << i;
    EXPECT_GT(tracked.inliers, 50) << i;
  }
}

TEST(FeatureTracker, PosesFramesByTheDepthsOfADepthCamera) {
  Tracking t(Sensor::kRgbd);
  (void)t.keyframe(0, street_T_world_cam(0));
  const TrackedFrame tracked = t.track(1);
  ASSERT_TRUE(tracked.outcome);
  EXPECT_LT(error(tracked.T_odom_cam, street_T_world_cam(1)), 0.03);
}

TEST(FeatureTracker, ALostFrameLeavesWhatIsFollowedAsItWas) {
  Tracking t;
  (void)t.keyframe(0, street_T_world_cam(0));
  ASSERT_TRUE(t.track(1).outcome);
  const FrameView before = t.tracker.view(t.map, t.motion.T_odom_cam());
  const TrackedFrame lost = t.track_dark();
  EXPECT_FALSE(lost.outcome);
  EXPECT_FALSE(lost.rotation);  // a stereo camera's translation is known, too
  const FrameView after = t.tracker.view(t.map, t.motion.T_odom_cam());
  ASSERT_EQ(before.tracks.size(), after.tracks.size());
  for (std::size_t i = 0; i < before.tracks.size(); ++i)
    EXPECT_EQ(before.tracks[i].px, after.tracks[i].px);
  EXPECT_TRUE(t.track(2).outcome);
}

TEST(FeatureTracker, FramesSinceTheLastKeyframeArePosedOnceMore) {
  Tracking t(Sensor::kStereo, "points", 1);  // only too few landmarks make a frame due
  const SE3 T_odom_world = pose({0.1, 0.5, 0}, {100, 20, -50});
  t.motion = MotionModel(T_odom_world * street_T_world_cam(0));
  (void)t.keyframe(0, T_odom_world * street_T_world_cam(0));
  int between = 0;
  for (int i = 1; i < 3; ++i) {
    const TrackedFrame tracked = t.track(i);
    ASSERT_TRUE(tracked.outcome);
    between += !tracked.keyframe_due;
  }
  ASSERT_GT(between, 0);
  const TrackedFrame last = t.track(3);
  ASSERT_TRUE(last.outcome);
  between += !last.keyframe_due;
  const auto posed = t.keyframe(3, last.T_odom_cam);
  EXPECT_EQ(posed.size(), static_cast<std::size_t>(between));
  for (const PosedFrame& frame : posed)
    EXPECT_LT(error(frame.second,
                    T_odom_world * street_T_world_cam(static_cast<int>(frame.first.value()))),
              0.02);
}

TEST(FeatureTracker, AKeyframeIsDueWhereTheImageHasMoved) {
  Tracking t(Sensor::kStereo, "points", 0.01);
  (void)t.keyframe(0, street_T_world_cam(0));
  TrackedFrame tracked;
  int i = 1;
  for (; i < 5 && !tracked.keyframe_due; ++i) tracked = t.track(i);
  EXPECT_TRUE(tracked.keyframe_due);
  (void)t.keyframe(i - 1, tracked.T_odom_cam);
  // Another keyframe: nothing has moved since.
  const TrackedFrame again =
      t.tracker.track(t.dataset.frame(static_cast<std::size_t>(i - 1), t.sensor), t.map,
                      MotionModel(tracked.T_odom_cam));
  ASSERT_TRUE(again.outcome);
  EXPECT_FALSE(again.keyframe_due);
}

TEST(FeatureTracker, TooFewDepthsAreNothingToBeginWith) {
  Tracking seen;
  (void)seen.keyframe(0, street_T_world_cam(0));
  EXPECT_TRUE(seen.tracker.enough_to_begin(seen.map));
  Tracking blind;
  Frame frame = blind.dataset.frame(0, Sensor::kStereo);
  frame.right = Image(frame.image.size(), CV_8UC1, cv::Scalar(0));
  blind.tracker.see_first(frame);
  const KeyframeImages images{frame, {}, nullptr};
  blind.map.add_keyframe(*blind.tracker.prepare_keyframe(images, SE3(), blind.map));
  blind.tracker.observe(images, {}, blind.map);
  const Outcome enough = blind.tracker.enough_to_begin(blind.map);
  EXPECT_FALSE(enough);
  EXPECT_NE(enough.reason.find("found in the right image"), std::string::npos);
}

TEST(FeatureTracker, ASingleCameraKnowsItsRotation) {
  const SO3 R = SO3::exp({0, 0.02, 0});
  const StreetDataset rotations(2, 0, 0, false, [&](int i) {
    return street_T_world_cam(0) * SE3(i == 0 ? SO3() : R, Eigen::Vector3d::Zero());
  });
  for (const bool rotates : {true, false}) {
    Tracking t(Sensor::kMono);
    PointCue& points = t.tracker.points();
    points.track(stereo_drive().frame(0, Sensor::kMono).image);
    points.detect({}, false, {});
    std::map<LandmarkId, Eigen::Vector2d> px;
    for (const PointTrack& track : points.tracks()) px[track.id] = track.px.cast<double>();
    points.track((rotates ? rotations : stereo_drive()).frame(1, Sensor::kMono).image);
    const auto rotation = t.tracker.rotation_since(px, FrameId(1));
    ASSERT_EQ(rotation.has_value(), rotates);
    if (rotates) {
      EXPECT_LT((rotation->R_before_cam.inverse() * R).log().norm(), 0.002);
    }
  }
}

/// A single camera whose map has begun with frames 0 to 2, at their true poses.
struct MonocularTracking : Tracking {
  explicit MonocularTracking(int min_inliers = Pose3d2dOptions().ransac.min_inliers)
      : Tracking(Sensor::kMono, "points", KeyframeOptions().max_flow_share, min_inliers) {
    for (int i = 0; i < 3; ++i) {
      if (i > 0) tracker.points().track(dataset.frame(i, sensor).image);
      (void)keyframe(i, street_T_world_cam(i));
    }
    motion = MotionModel(street_T_world_cam(2));
  }
};

TEST(FeatureTracker, ImagesContradictARotationThatTheyDoNotShow) {
  for (const double wrong_rad : {0.0, 0.06}) {
    MonocularTracking t;
    t.motion = MotionModel(street_T_world_cam(2) * pose({0, wrong_rad, 0}, {0, 0, 0}));
    const TrackedFrame tracked = t.track(3);
    ASSERT_TRUE(tracked.outcome) << tracked.outcome.reason;
    EXPECT_LT(error(tracked.T_odom_cam, street_T_world_cam(3)), 0.05);
    EXPECT_EQ(tracked.contradicted, wrong_rad > 0);
  }
}

TEST(FeatureTracker, AFrameWhosePointsLeaveItsRotationOpenIsLost) {
  constexpr int kFew = 4;
  MonocularTracking t(kFew);
  std::vector<Eigen::Vector2d> px;  // landmarks, the nearest to one of them first
  for (const FrameView::Track& track : t.tracker.view(t.map, street_T_world_cam(2)).tracks)
    if (track.px_projected) px.push_back(track.px);
  ASSERT_GT(px.size(), 50u);
  std::ranges::sort(px, {}, [first = px[0]](const auto& p) { return (p - first).norm(); });
  Image few(t.calibration.camera.height, t.calibration.camera.width, CV_8UC1, cv::Scalar(0));
  for (int i = 0; i < kFew + 1; ++i)
    few(cv::Rect(static_cast<int>(px[i].x()) - 1, static_cast<int>(px[i].y()) - 1, 4, 4))
        .setTo(255);
  t.tracker.drop_masked(few, t.map);
  const TrackedFrame tracked = t.track(3);
  EXPECT_EQ(tracked.outcome.code, Outcome::Code::kDegenerate) << tracked.outcome.reason;
}

TEST(FeatureTracker, ACameraThatMeasuresDepthIsNotAskedForRotations) {
  Tracking t;
  (void)t.keyframe(0, street_T_world_cam(0));
  std::map<LandmarkId, Eigen::Vector2d> px;
  for (const PointTrack& track : t.tracker.points().tracks())
    px[track.id] = track.px.cast<double>();
  EXPECT_FALSE(t.tracker.rotation_since(px, FrameId(1)));  // though nothing has moved
}

TEST(FeatureTracker, LandmarksOfTheTracksStandOnTheStreet) {
  Tracking t;
  (void)t.keyframe(0, street_T_world_cam(0));
  const std::vector<Eigen::Vector3d> points = t.tracker.points_odom(t.map);
  ASSERT_GT(points.size(), 100u);
  int near = 0;
  for (const Eigen::Vector3d& p : points)
    near += std::min({std::abs(p.y()), std::abs(std::abs(p.x()) - 5), std::abs(p.z() - 32)}) < 0.5;
  EXPECT_GT(near, 0.7 * static_cast<double>(points.size()));
  const FrameView view = t.tracker.view(t.map, street_T_world_cam(0));
  int projected = 0;
  for (const FrameView::Track& track : view.tracks)
    if (track.px_projected) {
      ++projected;
      EXPECT_LT((*track.px_projected - track.px).norm(), 4);
    }
  EXPECT_EQ(projected, static_cast<int>(points.size()));
}

TEST(FeatureTracker, AResetForgetsTracksAndFrames) {
  Tracking t;
  (void)t.keyframe(0, street_T_world_cam(0));
  (void)t.track(1);
  t.tracker.reset();
  EXPECT_TRUE(t.tracker.view(t.map, SE3()).tracks.empty());
  EXPECT_TRUE(t.tracker.points_odom(t.map).empty());
  EXPECT_FALSE(t.track(2).outcome);
}

TEST(FeatureTracker, ManhattanFramesAreUsedWhereTheSurroundingsHaveThem) {
  Tracking t;
  EXPECT_FALSE(t.tracker.corrects_rotations());
  Assumptions rooms;
  rooms.manhattan_frame = true;
  t.tracker.assume(rooms);
  EXPECT_TRUE(t.tracker.corrects_rotations());  // from now on
  EXPECT_NE(t.tracker.manhattan(), nullptr);
  rooms.manhattan_frame = false;
  t.tracker.assume(rooms);
  EXPECT_EQ(t.tracker.manhattan(), nullptr);
}

TEST(FeatureTracker, IntensitiesOfSurfacesJoinKeyframesThatPointsPose) {
  Tracking t(Sensor::kStereo, "points,direct");
  (void)t.keyframe(0, street_T_world_cam(0));
  ASSERT_TRUE(t.track(1).outcome);
  (void)t.keyframe(1, t.motion.T_odom_cam());
  ASSERT_EQ(t.map.window().factors().size(), 1u);
  EXPECT_EQ(t.map.window().factors()[0].variables,
            (std::vector{keyframe_variable(KeyframeId(0)), keyframe_variable(KeyframeId(1))}));
  EXPECT_FALSE(t.tracker.view(t.map, t.motion.T_odom_cam()).surfaces.empty());
  EXPECT_LT(error(t.map.pose(KeyframeId(1)), street_T_world_cam(1)), 0.02);
}

}  // namespace feature_tracker_test
}  // namespace placegraph
