#include <gtest/gtest.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/pipeline/cues/point_cue.h>

#include "tests/support/ids.h"
#include "tests/support/scenes/street.h"

namespace placegraph {
namespace point_cue_test {

using namespace test;

const StreetDataset& frames() {
  static const StreetDataset dataset(4);
  return dataset;
}
SE3 T_world_cam(int i) { return street_T_world_cam(i); }
double error(const SE3& a, const SE3& b) { return (a.inverse() * b).log().norm(); }

/// A stereo camera's points, with the first frame as a keyframe of the window.
struct Street {
  StageTimes times;
  Calibration calibration = frames().calibration(Sensor::kStereo);
  PointCue points{{}, calibration, {}, times};
  SlidingWindow window{{}, calibration.camera};

  Street() {
    const Frame first = frames().frame(0, Sensor::kStereo);
    points.track(first.image);
    points.detect({}, false, {});
    window.add_keyframe(KeyframeId(0), T_world_cam(0));
    points.observe(KeyframeId(0), first, {}, window);
  }
};

TEST(PointCue, PointsOfAStereoKeyframeBecomeLandmarksAtTheirDepth) {
  Street street;
  ASSERT_GT(street.points.tracked_landmarks(street.window), 100);
  std::vector<double> heights;
  for (const LandmarkId id : street.window.landmarks()) {
    const Eigen::Vector3d p = *street.window.landmark(id);
    // On the road, a house front or the end wall.
    heights.push_back(
        std::min({std::abs(p.y()), std::abs(std::abs(p.x()) - 5), std::abs(p.z() - 32)}));
  }
  EXPECT_LT(median_of(heights), 0.15);
}

TEST(PointCue, FollowsPointsAndPosesTheNextFrame) {
  Street street;
  Random random(1);
  const auto tracked = street.points.follow(frames().frame(1, Sensor::kStereo).image, street.window,
                                            T_world_cam(0), T_world_cam(0), false, 10, random);
  ASSERT_TRUE(tracked.pose.outcome) << tracked.pose.outcome.reason;
  EXPECT_LT(error(tracked.pose.T_ref_cam, T_world_cam(1)), 0.02);
  EXPECT_EQ(tracked.keep.size(), street.points.tracks().size());
  EXPECT_GT(std::count(tracked.keep.begin(), tracked.keep.end(), true), 100);
}

TEST(PointCue, EarlierObservationsOfANewLandmarkAreCorrectedByWhatIsKnownNow) {
  StageTimes times;
  const Calibration calibration = frames().calibration(Sensor::kStereo);
  PointCue points({}, calibration, {}, times);
  SlidingWindow window({}, calibration.camera);
  const Frame without_depth = frames().frame(0, Sensor::kMono);
  points.track(without_depth.image);
  points.detect({}, false, {});
  window.add_keyframe(KeyframeId(0), T_world_cam(0));
  points.observe(KeyframeId(0), without_depth, {}, window);
  ASSERT_TRUE(window.landmarks().empty());
  std::map<LandmarkId, Eigen::Vector2d> px;
  for (const PointTrack& track : points.tracks()) px[track.id] = track.px.cast<double>();

  RgbdErrors::Vector errors = RgbdErrors::Vector::Zero();
  errors[RgbdErrors::kPrincipalX] = 0.01;
  points.correct(RgbdErrors(errors));
  const Frame next = frames().frame(1, Sensor::kStereo);
  points.track(next.image);
  window.add_keyframe(KeyframeId(1), T_world_cam(1));
  points.observe(KeyframeId(1), next, {}, window);
  ASSERT_GT(window.landmarks().size(), 50u);
  const Eigen::Vector2d moved(0.01 * calibration.camera.fx, 0);
  int earlier = 0;
  for (const LandmarkId id : window.landmarks())
    for (const WindowObservation& o : window.observations(id))
      if (o.keyframe == KeyframeId(0)) {
        EXPECT_LT((px.at(id) - moved - o.px).norm(), 1e-4);
        ++earlier;
      }
  EXPECT_GT(earlier, 50);
}

TEST(PointCue, MaskedTracksAreDroppedWithTheirLandmarks) {
  Street street;
  Image mask(street_camera().height, street_camera().width, CV_8UC1, cv::Scalar(255));
  mask.colRange(0, mask.cols / 2).setTo(0);
  std::vector<LandmarkId> masked;
  for (const auto& [id, px] : street.points.landmark_pixels(street.window, T_world_cam(0)))
    if (px.x() < mask.cols / 2 - 1) masked.push_back(id);
  ASSERT_GT(masked.size(), 20U);
  street.points.drop_masked(mask, street.window);
  for (const LandmarkId id : masked) EXPECT_FALSE(street.window.landmark(id));
  EXPECT_GT(street.points.tracks().size(), 20U);
  for (const PointTrack& track : street.points.tracks()) EXPECT_GT(track.px.x(), mask.cols / 2 - 1);
}

TEST(PointCue, PosesAFrameAfterAStepThatIsTooWideForATracker) {
  Street street;
  Random random(1);
  const SE3 T_rotated = T_world_cam(0) * pose({0, 0.5, 0}, {0.1, 0, 0.2});
  const Image rotated = render(street.calibration.camera, T_rotated, test::street(), 2).grey;
  PointTracker wide = street.points.checkpoint();
  wide.track(rotated);
  const auto right =
      std::count_if(wide.tracks().begin(), wide.tracks().end(), [&](const PointTrack& track) {
        const auto point = street.window.landmark(track.id);
        const auto px =
            point ? street.calibration.camera.project(T_rotated.inverse() * *point) : std::nullopt;
        return px && (*px - track.px.cast<double>()).norm() < 2;
      });
  EXPECT_LT(right, 12);
  const auto tracked = street.points.follow(rotated, street.window, T_world_cam(0), T_world_cam(0),
                                            false, 10, random);
  ASSERT_TRUE(tracked.pose.outcome) << tracked.pose.outcome.reason;
  EXPECT_LT(error(tracked.pose.T_ref_cam, T_rotated), 0.03);
  EXPECT_EQ(tracked.keep.size(), street.points.tracks().size());
}

TEST(PointCue, TracksThatContradictThePoseAreMarked) {
  Street street;
  Random random(1);
  // A landmark that is not where its track sees it.
  const LandmarkId moved = street.window.landmarks().front();
  const auto px = street.points.landmark_pixels(street.window, T_world_cam(0));
  street.window.remove_landmark(moved);
  street.window.add_landmark(moved, T_world_cam(0) * Eigen::Vector3d(0.5, 0.1, 3));
  const auto tracked = street.points.pose(street.window, T_world_cam(0), random);
  ASSERT_TRUE(tracked.pose.outcome);
  for (std::size_t i = 0; i < street.points.tracks().size(); ++i)
    if (street.points.tracks()[i].id == moved) {
      EXPECT_FALSE(tracked.keep[i]);
    }
}

TEST(PointCue, GoesBackToACheckpoint) {
  Street street;
  Random random(1);
  const std::vector<PointTrack> before = street.points.tracks();
  const PointTracker checkpoint = street.points.checkpoint();
  Image dark =
      Image::zeros(street.calibration.camera.height, street.calibration.camera.width, CV_8UC1);
  EXPECT_FALSE(
      street.points.follow(dark, street.window, T_world_cam(0), T_world_cam(0), false, 10, random)
          .pose.outcome);
  street.points.restore(checkpoint);
  ASSERT_EQ(street.points.tracks().size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_EQ(street.points.tracks()[i].px, before[i].px);
}

TEST(PointCue, WithoutDepthAPointIsPlacedByItsParallax) {
  StageTimes times;
  const Calibration mono = frames().calibration(Sensor::kMono);
  PointCueOptions options;
  options.min_parallax_deg = 0.3;
  PointCue points(options, mono, {}, times);
  SlidingWindow window({}, mono.camera);
  points.track(frames().frame(0, Sensor::kMono).image);
  points.detect({}, false, {});
  window.add_keyframe(KeyframeId(0), T_world_cam(0));
  points.observe(KeyframeId(0), frames().frame(0, Sensor::kMono), {}, window);
  EXPECT_TRUE(window.landmarks().empty());
  for (int i = 1; i < 4; ++i) points.track(frames().frame(i, Sensor::kMono).image);
  window.add_keyframe(KeyframeId(1), T_world_cam(3));
  points.observe(KeyframeId(1), frames().frame(3, Sensor::kMono), {}, window);
  ASSERT_GT(window.landmarks().size(), 30u);
  std::vector<double> off_px;
  for (const LandmarkId id : window.landmarks()) {
    EXPECT_EQ(window.observations(id).size(), 2u);
    off_px.push_back(residual_px(window, window.observations(id).front())->norm());
  }
  EXPECT_LT(median_of(off_px), 1);
}

TEST(PointCue, ObservationsOfOneTrackCountForLessTheMoreThereAre) {
  Street street;
  const Frame second = frames().frame(1, Sensor::kStereo);
  street.points.track(second.image);
  street.window.add_keyframe(KeyframeId(1), T_world_cam(1));
  street.points.observe(KeyframeId(1), second, {}, street.window);
  int seen_twice = 0;
  for (const LandmarkId id : street.window.landmarks()) {
    const auto& observations = street.window.observations(id);
    if (observations.size() != 2) continue;
    for (const PointTrack& track : street.points.tracks()) {
      if (track.id != id) continue;
      ++seen_twice;
      EXPECT_LT((*observations[1].covariance_px - 2 * track.covariance.cast<double>()).norm(),
                1e-9);
    }
  }
  EXPECT_GT(seen_twice, 50);
}

TEST(PointCue, LandmarksThatMissTheirPixelAreDropped) {
  Street street;
  const LandmarkId good = street.window.landmarks().back();
  const LandmarkId wrong = street.window.landmarks().front();
  const WindowObservation seen = street.window.observations(wrong).front();
  const Eigen::Vector3d true_cam = T_world_cam(0).inverse() * *street.window.landmark(wrong);
  street.window.remove_landmark(wrong);
  street.window.add_landmark(  // 5 px off
      wrong, T_world_cam(0) * (true_cam + Eigen::Vector3d(5 * true_cam.z() / 330, 0, 0)));
  street.window.add_observation(seen);
  const std::size_t before = street.window.landmarks().size();
  const std::vector<double> depths = street.points.prune(street.window, KeyframeId(0));
  EXPECT_FALSE(street.window.landmark(wrong));
  EXPECT_TRUE(street.window.landmark(good));
  EXPECT_EQ(street.window.landmarks().size(), before - 1);
  EXPECT_EQ(depths.size(), before - 1);
  for (const double depth : depths) EXPECT_GT(depth, 1);
}

TEST(PointCue, TwoViewsStartAMapAndNewTracksWaitForDepth) {
  StageTimes times;
  const Calibration mono = frames().calibration(Sensor::kMono);
  PointCue points({}, mono, {}, times);
  SlidingWindow window({}, mono.camera);
  window.add_keyframe(KeyframeId(0), SE3());
  window.add_keyframe(KeyframeId(1), SE3(SO3(), Eigen::Vector3d(1, 0, 0)));
  const Eigen::Vector3d point(0.5, 0.2, 6);
  const Eigen::Vector2d ref = *mono.camera.project(point);
  const Eigen::Vector2d cur = *mono.camera.project(point - Eigen::Vector3d(1, 0, 0));
  points.observe_two_views(KeyframeId(0), KeyframeId(1),
                           {{LandmarkId(4), ref, cur, Eigen::Matrix2d::Identity(), point},
                            {LandmarkId(5), ref, cur, Eigen::Matrix2d::Identity(), std::nullopt}},
                           window);
  ASSERT_EQ(window.landmarks(), test::ids<LandmarkId>({4}));
  ASSERT_EQ(window.observations(LandmarkId(4)).size(), 2u);
  EXPECT_EQ(window.observations(LandmarkId(4))[0].px, ref);
  EXPECT_EQ(window.observations(LandmarkId(4))[1].px, cur);
  EXPECT_EQ(window.observations(LandmarkId(4))[1].keyframe, KeyframeId(1));
}

TEST(PointCue, MasksFromLabelsAreIgnoredWhereTheyLeaveTooFewPoints) {
  Street street;
  const Camera& camera = street.calibration.camera;
  const Image nowhere = Image::zeros(camera.height, camera.width, CV_8UC1);
  street.points.reset();
  street.points.track(frames().frame(0, Sensor::kStereo).image);
  street.points.detect(nowhere, false, {});
  EXPECT_TRUE(street.points.tracks().empty());
  street.points.detect(nowhere, true, {});
  EXPECT_GT(street.points.tracks().size(), 150u);
  const std::size_t all = street.points.tracks().size();
  street.points.drop_tracks_on_movable_objects(nowhere);
  EXPECT_EQ(street.points.tracks().size(), all);
  Image left_half = Image::zeros(camera.height, camera.width, CV_8UC1);
  left_half.colRange(0, camera.width * 4 / 5).setTo(255);
  street.points.drop_tracks_on_movable_objects(left_half);
  EXPECT_LT(street.points.tracks().size(), all);
  for (const PointTrack& track : street.points.tracks())
    EXPECT_LT(track.px.x(), camera.width * 4.0 / 5);
}

TEST(PointCue, DepthsOfLandmarksAreOfTheKeyframeAskedFor) {
  Street street;
  for (const KnownPixel& known : street.points.landmark_depths(street.window, KeyframeId(0))) {
    EXPECT_NEAR(known.depth.sigma, 0.03 * known.depth.value, 1e-12);
    EXPECT_GT(1 / known.depth.value, 1);
    EXPECT_LT(1 / known.depth.value, 40);
    EXPECT_EQ(known.depth.ray_cam.z(), 1);
  }
}

}  // namespace point_cue_test
}  // namespace placegraph
