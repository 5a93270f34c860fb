#include <gtest/gtest.h>
#include <placegraph/pipeline/odometry/odometry.h>

#include <opencv2/core.hpp>

#include "tests/support/scenes/street.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace odometry_test {

using namespace test;

constexpr int kFrames = 6;

/// A way along the street, drawn at random: 0.25 to 0.4 m a frame, with a bend.
struct Path {
  double start_m, step_m, yaw_rad, side_m;
  explicit Path(Random& random)
      : start_m(random.uniform(0, 5)),
        step_m(random.uniform(0.25, 0.4)),
        yaw_rad(random.uniform(-0.006, 0.006)),
        side_m(random.uniform(-0.03, 0.03)) {}
  SE3 operator()(int i) const {
    return pose({0, yaw_rad * i, 0}, {side_m * i, -kStreetHeight_m, start_m + step_m * i});
  }
};

/// Frames and calibration of a camera, with true poses.
struct Sequence {
  Calibration calibration;
  std::vector<Frame> frames;
  std::vector<SE3> T_world_cam;
};

Sequence drive(const Path& path, Sensor sensor) {
  const StreetDataset dataset(kFrames, 0, 0, sensor == Sensor::kRgbd, path);
  Sequence sequence{dataset.calibration(sensor), {}, {}};
  for (int i = 0; i < kFrames; ++i) {
    sequence.frames.push_back(dataset.frame(static_cast<std::size_t>(i), sensor));
    sequence.T_world_cam.push_back(path(i));
  }
  return sequence;
}

/// Poses of the frames that are tracked, later ones better; the first at `T_odom_first`.
std::map<FrameId, SE3> track(const Sequence& sequence, const std::string& cues,
                             const SE3& T_odom_first = SE3()) {
  StageTimes times;
  OdometryOptions options;
  options.cues = cues;
  Odometry odometry(options, sequence.calibration, 1, {}, times);
  odometry.restart(T_odom_first);
  std::map<FrameId, SE3> poses;
  for (const Frame& frame : sequence.frames) {
    const OdometryUpdate update = odometry.add_frame(frame);
    if (update.rescale)
      for (auto& [id, T] : poses)
        T = SE3(T.rotation(),
                update.rescale->centre_odom +
                    update.rescale->factor * (T.translation() - update.rescale->centre_odom));
    for (const auto& [id, T_odom_cam] : update.posed_again) poses[id] = T_odom_cam;
    if (update.state == TrackingState::kTracking) poses[frame.id] = update.T_odom_cam;
  }
  if (!odometry.map().empty()) poses.emplace(FrameId(0), odometry.map().pose(KeyframeId(0)));
  return poses;
}

/// Motion from the first to the last frame.
SE3 motion(const std::map<FrameId, SE3>& poses) {
  return poses.begin()->second.inverse() * poses.rbegin()->second;
}

/// Over a hundred tracks of 0.25 px at 330 px focal length, of things 10 m away, on a way of five
/// steps of 0.3 m.
constexpr double kTrackRad = 0.25 / 330, kDepthM = 10, kWayM = 1.5;
constexpr double kTracks = 100;
/// Other images: tracks of one texture may all err alike, then both ends of both motions are off by
/// as much as a track: 3 mrad, and 2 percent of the way.
constexpr double kAngleRad = 4 * kTrackRad, kShareOfPath = kAngleRad * kDepthM / kWayM;
/// The same images: tracks are the same, and descents end within the deviation of the motion that
/// is estimated from them: 0.08 mrad, and 0.05 percent of the way.
const double kSameAngleRad = kTrackRad / std::sqrt(kTracks),
             kSameShareOfPath = kSameAngleRad * kDepthM / kWayM;

void expect_same_motion(const SE3& a, const SE3& b) {
  EXPECT_LT(angle_rad(a, b), kAngleRad);
  EXPECT_LT(distance_m(a, b), kShareOfPath * (a.translation().norm() + b.translation().norm()) / 2);
}

/// The same images of a world s times larger, by what tells its size: baseline and depths.
Sequence enlarged(Sequence sequence, double s) {
  sequence.calibration.baseline_m *= s;
  if (sequence.calibration.camera_height_m) *sequence.calibration.camera_height_m *= s;
  if (sequence.calibration.depth) sequence.calibration.depth->sigma_at_1m /= s;
  for (Frame& frame : sequence.frames)
    if (!frame.depth.empty()) frame.depth = Image(s * frame.depth);  // not into the same pixels
  for (SE3& T : sequence.T_world_cam) T = T.scaled(s);
  return sequence;
}

TEST(OdometryLaws, ALargerWorldSeenByAWiderPairIsALongerWay) {
  Random random = seeded_random(1);
  for (int trial = 0; trial < 2; ++trial) {
    const Sequence sequence = drive(Path(random), Sensor::kStereo);
    const SE3 as_it_is = motion(track(sequence, "points"));
    for (const double s : {0.3, random.uniform(2, 5)}) {
      const SE3 longer = motion(track(enlarged(sequence, s), "points"));
      SCOPED_TRACE(s);
      EXPECT_LT(angle_rad(as_it_is, longer), kSameAngleRad);
      EXPECT_LT(distance_m(as_it_is.scaled(s), longer),
                kSameShareOfPath * longer.translation().norm());
    }
  }
}

TEST(OdometryLaws, ExchangedAndMirroredCamerasSeeTheMirroredWay) {
  Random random = seeded_random(3);
  for (int trial = 0; trial < 3; ++trial) {
    const Sequence sequence = drive(Path(random), Sensor::kStereo);
    Sequence mirrored = sequence;
    mirrored.calibration.camera.cx =
        sequence.calibration.camera.width - 1 - sequence.calibration.camera.cx;
    for (std::size_t i = 0; i < sequence.frames.size(); ++i) {
      mirrored.frames[i].image = flipped(sequence.frames[i].right);
      mirrored.frames[i].right = flipped(sequence.frames[i].image);
    }
    const SE3 T = motion(track(sequence, "points")), T_mirrored = motion(track(mirrored, "points"));
    // The mirrored left camera is the right one: its motion, with x turned over.
    const SE3 T_left_right = pose({0, 0, 0}, {sequence.calibration.baseline_m, 0, 0});
    const SE3 of_right = T_left_right.inverse() * T * T_left_right;
    const Eigen::Vector3d w = of_right.rotation().log(), t = of_right.translation();
    expect_same_motion(T_mirrored, pose({w.x(), -w.y(), -w.z()}, {-t.x(), t.y(), t.z()}));
  }
}

TEST(OdometryLaws, BackwardsTheMotionIsTheInverse) {
  Random random = seeded_random(4);
  for (int trial = 0; trial < 3; ++trial) {
    const Sequence sequence = drive(Path(random), Sensor::kStereo);
    Sequence backwards = sequence;
    std::reverse(backwards.frames.begin(), backwards.frames.end());
    for (std::size_t i = 0; i < backwards.frames.size(); ++i) {
      backwards.frames[i].id = sequence.frames[i].id;
      backwards.frames[i].stamp_ns = sequence.frames[i].stamp_ns;
    }
    expect_same_motion(motion(track(backwards, "points")).inverse(),
                       motion(track(sequence, "points")));
  }
}

TEST(OdometryLaws, TheFrameOfTheOdometryIsArbitrary) {
  Random random = seeded_random(5);
  for (int trial = 0; trial < 2; ++trial) {
    const Sequence sequence = drive(Path(random), Sensor::kStereo);
    const SE3 here = motion(track(sequence, "points"));
    const SE3 T_other = SE3::exp(Vector6d::NullaryExpr([&] { return random.uniform(-2, 2); }));
    const SE3 there = motion(track(sequence, "points", T_other));
    EXPECT_LT(angle_rad(here, there), kSameAngleRad);
    EXPECT_LT(distance_m(here, there), kSameShareOfPath * here.translation().norm());
  }
}

TEST(OdometryLaws, DepthsGiveTheUnit) {
  Random random = seeded_random(6);
  const Sequence sequence = drive(Path(random), Sensor::kRgbd);
  const SE3 as_it_is = motion(track(sequence, "points"));
  for (const double s : {0.5, 2.0}) {
    const SE3 longer = motion(track(enlarged(sequence, s), "points"));
    EXPECT_LT(angle_rad(as_it_is, longer), kSameAngleRad) << s;
    EXPECT_LT(distance_m(as_it_is.scaled(s), longer),
              kSameShareOfPath * longer.translation().norm())
        << s;
  }
}

/// Road 5 m ahead moves by f h t / z^2 = 5.4 px in the shortest step, 0.25 m; 0.25 px of them are
/// 4.6 percent.
constexpr double kShareOfRoad = 0.25 / (330 * kStreetHeight_m * 0.25 / (5 * 5));

TEST(OdometryLaws, TheHeightOfASingleCameraGivesTheUnit) {
  Random random = seeded_random(7);
  Sequence sequence = drive(Path(random), Sensor::kMono);
  sequence.calibration.camera_height_m = kStreetHeight_m;
  const SE3 truth = sequence.T_world_cam.front().inverse() * sequence.T_world_cam.back();
  const SE3 as_it_is = motion(track(sequence, "points,plane"));
  EXPECT_NEAR(as_it_is.translation().norm() / truth.translation().norm(), 1, kShareOfRoad);
  for (const double s : {0.2, 3.0}) {
    const SE3 longer = motion(track(enlarged(sequence, s), "points,plane"));
    EXPECT_LT(angle_rad(as_it_is, longer), kAngleRad) << s;
    EXPECT_NEAR(longer.translation().norm() / as_it_is.translation().norm() / s, 1, kShareOfPath)
        << s;
  }
}

TEST(OdometryLaws, SurfacesOfALargerWorldAreALongerWay) {
  Random random = seeded_random(8);
  Sequence sequence = drive(Path(random), Sensor::kStereo);
  sequence.calibration.camera_height_m = kStreetHeight_m;
  const SE3 truth = sequence.T_world_cam.front().inverse() * sequence.T_world_cam.back();
  const SE3 as_it_is = motion(track(sequence, "plane"));
  EXPECT_LT(distance_m(as_it_is, truth), kShareOfRoad * truth.translation().norm());
  for (const double s : {0.4, 2.5}) {
    const SE3 longer = motion(track(enlarged(sequence, s), "plane"));
    EXPECT_LT(angle_rad(as_it_is, longer), kAngleRad) << s;
    EXPECT_LT(distance_m(as_it_is.scaled(s), longer), kShareOfPath * longer.translation().norm())
        << s;
  }
}

}  // namespace odometry_test
}  // namespace placegraph
