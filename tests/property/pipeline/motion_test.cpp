#include <gtest/gtest.h>
#include <placegraph/pipeline/local_map/metric_scale.h>
#include <placegraph/pipeline/slam/trajectory_recorder.h>
#include <placegraph/pipeline/tracking/motion_model.h>

#include "tests/support/scenes/window_world.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace motion_test {

using namespace test;

constexpr int kTrials = 50;
constexpr std::int64_t kSecond = 1'000'000'000;

double error(const SE3& a, const SE3& b) { return (a.inverse() * b).log().norm(); }
SE3 anywhere(Random& random) { return random_motion(random, 5, 0.8); }

// MotionModel -------------------------------------------------------------------------------------

TEST(MotionModelLaws, AConstantMotionIsPredicted) {
  Random random = seeded_random(1);
  for (int trial = 0; trial < kTrials; ++trial) {
    const SE3 T_last_cur = random_motion(random, 1, 0.3);
    MotionModel motion(anywhere(random));
    SE3 T_odom_cam = motion.T_odom_cam();
    for (int i = 0; i < 3; ++i) {
      T_odom_cam = T_odom_cam * T_last_cur;
      motion.update(T_odom_cam);
    }
    EXPECT_LT(error(motion.predicted(), T_odom_cam * T_last_cur), 1e-9);
  }
}

TEST(MotionModelLaws, RotatingTheWorldRotatesThePrediction) {
  Random random = seeded_random(2);
  for (int trial = 0; trial < kTrials; ++trial) {
    const SE3 T_other_odom = anywhere(random), a = anywhere(random),
              b = a * random_motion(random, 1, 0.3);
    MotionModel here(a), there(T_other_odom * a);
    here.update(b);
    there.update(T_other_odom * b);
    EXPECT_LT(error(T_other_odom * here.predicted(), there.predicted()), 1e-9);
    EXPECT_LT(
        (here.information({0.1, 0.2, 0.03}, 5) - there.information({0.1, 0.2, 0.03}, 5)).norm(),
        1e-6);
  }
}

TEST(MotionModelLaws, BackwardsTheVelocityIsTheInverse) {
  Random random = seeded_random(3);
  for (int trial = 0; trial < kTrials; ++trial) {
    const SE3 a = anywhere(random), b = a * random_motion(random, 1, 0.3);
    MotionModel forwards(a), backwards(b);
    forwards.update(b);
    backwards.update(a);
    EXPECT_LT(error(forwards.T_last_cur() * backwards.T_last_cur(), SE3()), 1e-9);
    // One step on from where either ends, and back by the other.
    EXPECT_LT(error(forwards.predicted() * backwards.T_last_cur(), b), 1e-9);
  }
}

TEST(MotionModelLaws, TheUnitOfLengthChangesLengthsAlone) {
  Random random = seeded_random(4);
  for (int trial = 0; trial < kTrials; ++trial) {
    const double unit = random.uniform(0.1, 10);
    const SE3 a = anywhere(random), b = a * random_motion(random, 1, 0.3);
    MotionModel metres(a), units(a.scaled(unit)), rescaled(a);
    metres.update(b);
    units.update(b.scaled(unit));
    rescaled.update(b);
    rescaled.rescale_velocity(unit);
    rescaled.correct(b.scaled(unit));
    EXPECT_LT(error(metres.predicted().scaled(unit), units.predicted()), 1e-9);
    EXPECT_LT(error(rescaled.predicted(), units.predicted()), 1e-9);
    const Matrix6d in_metres = metres.information({0.1, 0.2, 0.03}, 5),
                   in_units = units.information({0.1, 0.2, 0.03}, 5 * unit);
    EXPECT_NEAR(in_metres(0, 0) / in_units(0, 0), unit * unit, 1e-6 * unit * unit);
    EXPECT_NEAR(in_metres(5, 5) / in_units(5, 5), 1, 1e-9);
  }
}

// MetricScale -------------------------------------------------------------------------------------

/// A walk of random steps, and what another sensor measured of it.
struct Walk {
  std::vector<SE3> T_world_cam;
  std::shared_ptr<const MeasuredMotion> measured;

  explicit Walk(Random& random, double noise = 0) {
    T_world_cam.emplace_back();
    std::vector<MotionStep> steps;
    for (int k = 0; k < 8; ++k) {
      T_world_cam.push_back(T_world_cam.back() *
                            SE3(SO3::exp({0, random.normal(0, 0.1), 0}),
                                Eigen::Vector3d(random.normal(0, 0.1), 0, random.uniform(1, 2))));
      MotionStep step;
      step.from_ns = k * kSecond;
      step.to_ns = (k + 1) * kSecond;
      const SE3 T = T_world_cam[static_cast<std::size_t>(k)].inverse() * T_world_cam.back();
      step.T_from_to = T.scaled(1 + random.normal(0, noise));
      step.covariance = 1e-4 * Matrix6d::Identity();
      steps.push_back(step);
    }
    measured = std::make_shared<const MeasuredMotion>(steps);
  }
  /// The factor that the scale is found to be wrong by, where a camera saw the walk from
  /// `T_odom_world` in units of `unit` metres.
  double factor(const SE3& T_odom_world, double unit) const {
    LocalMap map({}, window_camera(), Scale::kArbitrary);
    MetricScale scale{{}};
    scale.use_motion(measured);
    for (std::size_t k = 0; k < T_world_cam.size(); ++k) {
      map.add_keyframe((T_odom_world * T_world_cam[k]).scaled(1 / unit));
      map.update_poses({}, false);
      Frame frame;
      frame.id = FrameId(k);
      frame.stamp_ns = frame.id.value() * kSecond;
      if (const auto rescale = scale.measure({frame, {}, nullptr}, {}, map)) return rescale->factor;
    }
    ADD_FAILURE() << "no scale";
    return 0;
  }
};

TEST(MetricScaleLaws, TheFactorIsTheUnitWhateverTheFrame) {
  Random random = seeded_random(5);
  for (int trial = 0; trial < kTrials; ++trial) {
    const double unit = random.uniform(0.05, 20);
    EXPECT_NEAR(Walk(random).factor(anywhere(random), unit), unit, 1e-9 * unit);
  }
}

TEST(MetricScaleLaws, NoiseOfTheMotionIsTheNoiseOfTheFactor) {
  Random random = seeded_random(6);
  double square = 0;
  constexpr double kNoise = 0.02;
  for (int trial = 0; trial < kTrials; ++trial) {
    const double off = std::log(Walk(random, kNoise).factor(SE3(), 1));
    square += off * off / kTrials;
  }
  // The median of five: its deviation is sqrt(pi / 2 / 5) of one's.
  EXPECT_LT(std::sqrt(square), 0.8 * kNoise);
  EXPECT_GT(std::sqrt(square), 0.3 * kNoise);
}

TEST(MetricScaleLaws, TwoUnitsMultiply) {
  Random random = seeded_random(7);
  for (int trial = 0; trial < kTrials; ++trial) {
    const Walk walk(random, 0.05);
    const double a = random.uniform(0.1, 10);
    EXPECT_NEAR(walk.factor(SE3(), a) / walk.factor(SE3(), 1), a, 1e-9 * a);
  }
}

// TrajectoryRecorder ------------------------------------------------------------------------------

/// Frames between keyframes of a walk, recorded from an odometry frame of its own.
struct Recording {
  LocalMap map{{}, window_camera(), Scale::kArbitrary};
  TrajectoryRecorder recorder;
  std::vector<SE3> T_odom_frame;

  Recording(const std::vector<SE3>& T_world_frame, const SE3& T_odom_world, double unit) {
    KeyframeId keyframe;
    for (std::size_t i = 0; i < T_world_frame.size(); ++i) {
      T_odom_frame.push_back((T_odom_world * T_world_frame[i]).scaled(1 / unit));
      Frame frame;
      frame.id = FrameId(i);
      frame.stamp_ns = frame.id.value() * kSecond;
      recorder.begin(frame);
      if (i % 3 == 0) {
        keyframe = map.add_keyframe(T_odom_frame.back());
        map.update_poses({}, false);
        recorder.add_keyframe({keyframe, frame});
      }
      recorder.record(keyframe, map.pose(keyframe).inverse() * T_odom_frame.back(), 10);
      recorder.finish(T_odom_frame.back(), 0);
    }
  }
};
std::vector<SE3> random_walk(Random& random, int frames) {
  std::vector<SE3> poses{SE3()};
  while (static_cast<int>(poses.size()) < frames)
    poses.push_back(poses.back() * random_motion(random, 0.5, 0.1));
  return poses;
}

TEST(TrajectoryRecorderLaws, TheFrameOfTheOdometryChangesNoRecord) {
  Random random = seeded_random(8);
  for (int trial = 0; trial < kTrials; ++trial) {
    const std::vector<SE3> walk = random_walk(random, 9);
    const SE3 T_other = anywhere(random);
    Recording here(walk, SE3(), 1), there(walk, T_other, 1);
    // The same frames are posed once more, each in its own odometry frame.
    std::vector<PosedFrame> posed_here, posed_there;
    for (const int i : {4, 5, 7}) {
      const SE3 better = walk[static_cast<std::size_t>(i)] * random_motion(random, 0.1, 0.02);
      posed_here.emplace_back(i, better);
      posed_there.emplace_back(i, T_other * better);
    }
    here.recorder.correct(posed_here, KeyframeId(2), here.map);
    there.recorder.correct(posed_there, KeyframeId(2), there.map);
    for (std::size_t i = 0; i < walk.size(); ++i) {
      const FrameRecord &a = here.recorder.records()[i], &b = there.recorder.records()[i];
      EXPECT_EQ(a.keyframe, b.keyframe);
      EXPECT_LT(error(*a.T_keyframe_frame, *b.T_keyframe_frame), 1e-9) << i;
    }
  }
}

TEST(TrajectoryRecorderLaws, ARescaledRecordIsThatOfTheOtherUnit) {
  Random random = seeded_random(9);
  for (int trial = 0; trial < kTrials; ++trial) {
    const std::vector<SE3> walk = random_walk(random, 7);
    const double unit = random.uniform(0.1, 10), more = random.uniform(0.5, 2);
    Recording units(walk, SE3(), unit), metres(walk, SE3(), 1);
    units.recorder.rescale(KeyframeId(0), unit / more);  // in two steps
    units.recorder.rescale(KeyframeId(0), more);
    for (std::size_t i = 0; i < walk.size(); ++i)
      EXPECT_LT(error(*units.recorder.records()[i].T_keyframe_frame,
                      *metres.recorder.records()[i].T_keyframe_frame),
                1e-9);
  }
}

TEST(TrajectoryRecorderLaws, OnlyLaterKeyframesAreRescaled) {
  Random random = seeded_random(10);
  for (int trial = 0; trial < kTrials; ++trial) {
    const std::vector<SE3> walk = random_walk(random, 9);
    Recording before(walk, SE3(), 1), after(walk, SE3(), 1);
    const std::int64_t from = 1 + static_cast<std::int64_t>(random.index(2));
    after.recorder.rescale(KeyframeId(from), 3);
    for (std::size_t i = 0; i < walk.size(); ++i) {
      const FrameRecord &a = before.recorder.records()[i], &b = after.recorder.records()[i];
      const double factor = a.keyframe >= KeyframeId(from) ? 3 : 1;
      EXPECT_LT(error(a.T_keyframe_frame->scaled(factor), *b.T_keyframe_frame), 1e-9) << i;
    }
  }
}

// LocalMap ----------------------------------------------------------------------------------------

TEST(LocalMapLaws, RescalingTwiceIsRescalingOnceByTheProduct) {
  Random random = seeded_random(11);
  for (int trial = 0; trial < kTrials; ++trial) {
    const double a = random.uniform(0.2, 5), b = random.uniform(0.2, 5);
    LocalMap twice({}, window_camera(), Scale::kArbitrary),
        once({}, window_camera(), Scale::kArbitrary);
    for (const SE3& T : random_walk(random, 4)) {
      twice.add_keyframe(T);
      once.add_keyframe(T);
    }
    const Eigen::Vector3d point(1, 2, 9);
    for (LocalMap* map : {&twice, &once}) {
      map->window().add_landmark(LandmarkId(5), point);
      map->update_poses({4}, false);
    }
    (void)twice.rescale(a);
    (void)twice.rescale(b);
    (void)once.rescale(a * b);
    EXPECT_NEAR(twice.median_depth(), once.median_depth(), 1e-9 * once.median_depth());
    EXPECT_LT(
        (*twice.window().landmark(LandmarkId(5)) - *once.window().landmark(LandmarkId(5))).norm(),
        1e-9);
    for (std::int64_t k = 0; k < 4; ++k)
      EXPECT_LT(error(twice.pose(KeyframeId(k)), once.pose(KeyframeId(k))), 1e-9) << k;
  }
}

TEST(LocalMapLaws, RelativePosesDoNotDependOnTheFrame) {
  Random random = seeded_random(12);
  for (int trial = 0; trial < 10; ++trial) {
    WindowWorldOptions options;
    options.keyframes = 5;
    options.landmarks = 60;
    options.noise_px = 0.5;
    const WindowWorld world = make_window_world(options, random);
    const SE3 T_other = random_motion(random, 3, 0.5);
    std::vector<SE3> motions;
    std::vector<Matrix6d> informations;
    for (const SE3& T_odom_world : {SE3(), T_other}) {
      LocalMap map({}, world.camera, Scale::kArbitrary);
      for (const SE3& T : world.T_map_cam) map.add_keyframe(T_odom_world * T);
      for (std::size_t i = 0; i < world.points.size(); ++i)
        map.window().add_landmark(LandmarkId(i), T_odom_world * world.points[i]);
      for (const WindowObservation& o : world.observations) map.window().add_observation(o);
      ASSERT_TRUE(map.optimize());
      map.update_poses({}, false);
      motions.push_back(map.pose(KeyframeId(1)).inverse() * map.pose(KeyframeId(3)));
      informations.push_back(map.information(map.motion(KeyframeId(1), KeyframeId(3))));
    }
    // The descent ends within a thousandth of the decrease of its cost.
    EXPECT_LT(error(motions[0], motions[1]), 1e-3);
    EXPECT_LT((informations[0] - informations[1]).norm(), 0.02 * informations[0].norm());
  }
}

}  // namespace motion_test
}  // namespace placegraph
