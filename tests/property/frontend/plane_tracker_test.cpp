#include <gtest/gtest.h>
#include <placegraph/frontend/align/plane_tracker.h>

#include <Eigen/Dense>
#include <opencv2/imgproc.hpp>

#include "tests/support/scenes/board.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace plane_tracker_test {

using namespace test;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

const Vector2d kMiddle(160, 115);

/// Two pixels a frame, turning, nearing, tilting.
Matrix3d smooth_view(int frame) {
  const double t = frame;
  return view_of(kMiddle, 0.015 * t, 1 + 0.2 * std::sin(0.2 * t),
                 {2.0 * t - 0.03 * t * t, -1.2 * t}, {2e-5 * t, -3e-5 * t});
}

void hide(Image& image, double left, double width_px, const Texture& other) {
  for (int v = 0; v < image.rows; ++v)
    for (int u = std::max(0, static_cast<int>(left));
         u < std::min(image.cols, static_cast<int>(left + width_px)); ++u)
      image.at<std::uint8_t>(v, u) = to_grey(other.grey(u, v));
}

TEST(PlaneTracker, FollowsThroughOtherLightBlurAndOcclusion) {
  Random random = seeded_random(101);
  const Board board(random);
  const Texture other{random.next(), 24, 3, 50, 128};
  PlaneTracker tracker(board.picture(Matrix3d::Identity()), board.corners, {});
  ASSERT_TRUE(tracker.outcome()) << tracker.outcome().reason;
  std::vector<double> errors;
  for (int frame = 0; frame < 24; ++frame) {
    const Matrix3d H = smooth_view(frame);
    Image image = disturbed(board.picture(H), 2, random, 1 - 0.015 * frame, 1.0 * frame);
    if (frame >= 6 && frame < 11) cv::GaussianBlur(image, image, {}, 1.5);
    if (frame >= 13 && frame < 21) {
      const double left = (*map_pixel(H, board.corners[0])).x();
      hide(image, left + 8.0 * (frame - 13), 30, other);
    }
    const PlaneTrack track = tracker.track(image);
    ASSERT_TRUE(track.outcome) << "frame " << frame << ": " << track.outcome.reason;
    errors.push_back(board.error_px(track.corners_px, H));
    // Corners lie on the edge of another texture and beyond the samples: about five deviations.
    EXPECT_LT(errors.back(), 1.5) << "frame " << frame;
  }
  const double last = errors.back();
  std::sort(errors.begin(), errors.end());
  std::cout << "median " << errors[12] << " px, worst " << errors.back() << " px\n";
  EXPECT_LT(errors[12], 0.3);
  EXPECT_LT(last, 0.6) << "it drifts";
}

TEST(PlaneTracker, SaysThatTheTemplateIsGoneAndFindsItAgainElsewhere) {
  Random random = seeded_random(102);
  for (int trial = 0; trial < 2; ++trial) {
    const Board board(random);
    PlaneTracker tracker(board.picture(Matrix3d::Identity()), board.corners, {});
    constexpr int kGone = 3, kBack = 7, kEnd = 10;
    const Matrix3d elsewhere =
        view_of(kMiddle, random.uniform(-0.8, 0.8), random.uniform(0.7, 1.2),
                {trial == 0 ? -70.0 : 75.0, random.uniform(-30, 40)}, {2e-4, -3e-4});
    int found = -1;
    for (int frame = 0; frame < kEnd; ++frame) {
      const bool there = frame < kGone || frame >= kBack;
      const Matrix3d H =
          frame < kGone ? smooth_view(frame)
                        : view_of({0, 0}, 0, 1, {1.5 * (frame - kBack), 0}, {0, 0}) * elsewhere;
      const PlaneTrack track = tracker.track(
          disturbed(board.picture(there ? std::optional<Matrix3d>(H) : std::nullopt), 2, random));
      if (!there) {
        EXPECT_FALSE(track.outcome)
            << "frame " << frame << ", likeness " << track.robust_similarity;
        continue;
      }
      EXPECT_TRUE(track.outcome || frame >= kGone) << track.outcome.reason;
      if (!track.outcome) continue;
      EXPECT_LT(board.error_px(track.corners_px, H), 1);
      if (frame >= kBack && found < 0) found = frame;
    }
    EXPECT_GE(found, kBack) << "not found again";
    EXPECT_LE(found, kBack + 2);
  }
}

TEST(PlaneTracker, TakesNothingElseForTheTemplate) {
  Random random = seeded_random(103);
  const Board board(random);
  PlaneTracker tracker(board.picture(Matrix3d::Identity()), board.corners, {});
  for (int frame = 0; frame < 6; ++frame) {
    const Board other(random);
    const PlaneTrack track = tracker.track(disturbed(other.picture(smooth_view(frame)), 2, random));
    EXPECT_FALSE(track.outcome) << "frame " << frame;
  }
}

TEST(PlaneTracker, ErrsAsItsCovarianceSays) {
  Random random = seeded_random(104);
  double nees = 0;
  int count = 0;
  for (int trial = 0; trial < 3; ++trial) {
    const Board board(random);
    PlaneTracker tracker(disturbed(board.picture(Matrix3d::Identity()), 4, random), board.corners,
                         {});
    for (int frame = 1; frame < 8; ++frame) {
      const Matrix3d H = smooth_view(frame);
      const PlaneTrack track = tracker.track(disturbed(board.picture(H), 4, random));
      ASSERT_TRUE(track.outcome) << track.outcome.reason;
      Eigen::Matrix<double, 8, 1> e;
      for (int c = 0; c < 4; ++c)
        e.segment<2>(2 * c) = track.corners_px[c] - *map_pixel(H, board.corners[c]);
      nees += e.dot(track.covariance.ldlt().solve(e)) / 8;
      ++count;
    }
  }
  std::cout << "normalized error squared per degree of freedom " << nees / count << "\n";
  // The noise of the first image is the same in all frames of a trial: 24 degrees of freedom count.
  EXPECT_GT(nees / count, 0.3);
  EXPECT_LT(nees / count, 2.5);
}

/// A board before a camera of 300 px that goes around it.
struct CameraWorld {
  Camera camera{320, 240, 300, 300, 160, 120, Distortion::kNone, {}};
  Plane plane{Vector3d(0.2, -0.15, 0.97).normalized(), 1};
  SE3 T_cur_ref(int frame) const {
    // An arc: along a straight line the two readings stay hard to tell apart.
    const double t = 0.2 * frame;
    Vector6d x;
    x << 0.2 * std::sin(t), 0.15 * (1 - std::cos(t)), 0.03 * t, -0.04 * t, -0.15 * std::sin(t),
        0.03 * t;
    return SE3::exp(x);
  }
  Matrix3d H(int frame) const { return homography_from_plane(camera.K(), T_cur_ref(frame), plane); }
};

TEST(PlaneTracker, TellsTheMotionBeforeThePlaneOnceViewsLeaveOneReading) {
  Random random = seeded_random(105);
  const Board board(random);
  const CameraWorld world;
  PlaneTracker tracker(board.picture(Matrix3d::Identity()), board.corners, {}, world.camera);
  PlaneTrack track;
  for (int frame = 0; frame < 16; ++frame) {
    track = tracker.track(disturbed(board.picture(world.H(frame)), 2, random));
    ASSERT_TRUE(track.outcome) << track.outcome.reason;
    EXPECT_TRUE(frame > 0 || !track.T_cur_ref) << "nothing moved yet";
  }
  ASSERT_TRUE(track.T_cur_ref) << track.normal_outcome.reason;
  const double apart = std::acos(std::min(1.0, track.normal_ref.dot(world.plane.normal)));
  std::cout << "normal off by " << apart << " rad, sigma " << track.normal_sigma_rad << "\n";
  EXPECT_LT(apart, 0.05);
  const SE3 error = track.T_cur_ref->inverse() * world.T_cur_ref(15);
  // 0.3 m of way; depth and tilt of a board of a third of the image are nearly one.
  EXPECT_LT(error.translation().norm(), 0.02);
  EXPECT_LT(error.rotation().log().norm(), 0.03);
}

TEST(PlaneTracker, FollowsWithFewerDegreesOfFreedomWhereThePlaneIsKnown) {
  Random random = seeded_random(106);
  const Board board(random);
  const CameraWorld world;
  for (const PlaneModel model : {PlaneModel::kSe3Plane, PlaneModel::kSe2Plane}) {
    PlaneTrackerOptions options;
    options.model = model;
    PlaneTracker tracker(board.picture(Matrix3d::Identity()), board.corners, options, world.camera,
                         world.plane.normal);
    for (int frame = 0; frame < 6; ++frame) {
      const SE2 along(0.01 * frame, -0.012 * frame, 0.02 * frame);
      const Matrix3d H =
          model == PlaneModel::kSe3Plane
              ? world.H(frame)
              : PlanarWarp::planar_motion(world.camera.K(), along, world.plane).H_cur_ref();
      const PlaneTrack track = tracker.track(disturbed(board.picture(H), 2, random));
      ASSERT_TRUE(track.outcome) << track.outcome.reason;
      EXPECT_LT(board.error_px(track.corners_px, H), 0.5);
    }
  }
}

TEST(PlaneTracker, GivesTheSameBitsOnAnyNumberOfThreads) {
  Random random = seeded_random(107);
  const Board board(random);
  const Image first = board.picture(Matrix3d::Identity());
  const Image far =
      disturbed(board.picture(view_of(kMiddle, 0.3, 0.9, {45, -20}, {1e-4, 0})), 2, random);
  std::vector<PlaneTrack> tracks;
  for (const int threads : {1, 3}) {
    PlaneTrackerOptions options;
    options.align.swarm.threads = threads;
    PlaneTracker tracker(first, board.corners, options);
    tracks.push_back(tracker.track(far));
  }
  ASSERT_EQ(tracks[0].outcome.code, tracks[1].outcome.code);
  EXPECT_EQ(tracks[0].H_cur_ref, tracks[1].H_cur_ref);
  EXPECT_EQ(tracks[0].robust_similarity, tracks[1].robust_similarity);
}

}  // namespace plane_tracker_test
}  // namespace placegraph
