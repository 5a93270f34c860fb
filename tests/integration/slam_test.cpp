#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/eval/trajectory/evaluate.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/run.h>

#include <opencv2/core/utility.hpp>

#include "tests/support/map_bits.h"
#include "tests/support/scenes/street.h"

namespace placegraph {
namespace slam_test {

using namespace test;

constexpr int kFrames = 24;  // 9.2 m
const StreetDataset& drive() {
  static const StreetDataset dataset(kFrames);
  return dataset;
}

/// Features and tracks enough for pictures of this size.
SlamOptions small_options() {
  SlamOptions options;
  options.odometry.points.tracker.max_tracks = 250;
  options.loops.detector.max_features = 400;
  return options;
}

RunOptions run_as(SensorChoice sensor) {
  RunOptions options;
  options.sensor = sensor;
  options.slam = small_options();
  return options;
}

EvaluationResult judge(const StreetDataset& dataset, const Trajectory& trajectory,
                       Alignment alignment) {
  EvaluationOptions options;
  options.alignment = alignment;
  return evaluate(*dataset.ground_truth(), trajectory, options);
}

TEST(SlamOnAStreet, PosesEveryFrameWithStereo) {
  const RunResult run = run_sequence(drive(), run_as(SensorChoice::kStereo));
  EXPECT_EQ(run.sensor, Sensor::kStereo);
  EXPECT_TRUE(run.map.metric);
  EXPECT_EQ(run.map.frames.size(), drive().size());
  EXPECT_EQ(run.map.trajectory_online.posed(), drive().size());
  const Trajectory optimized = run.map.trajectory_optimized();
  EXPECT_EQ(optimized.posed(), drive().size());
  // A track is good to a twentieth of a pixel of 330 px focal length; disparities set the scale:
  // 0.1 px of 15.
  for (const Trajectory* trajectory : {&run.map.trajectory_online, &optimized}) {
    const EvaluationResult result = judge(drive(), *trajectory, Alignment::kOrigin);
    ASSERT_TRUE(result.outcome) << result.outcome.reason;
    EXPECT_LT(result.ape.error_m.rmse, 0.01 * result.path_m);
    EXPECT_LT(result.rpe.rotation_deg.median, 0.05);
  }
  EXPECT_GE(run.map.keyframes.size(), 4u);
  EXPECT_FALSE(run.map.place_graph.places.empty());
  for (const RelativePoseConstraint& c : run.map.place_graph.constraints)
    EXPECT_GT(c.information.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 0);
}

TEST(SlamOnAStreet, PosesEveryFrameWithOneCameraUpToScale) {
  const RunResult run = run_sequence(drive(), run_as(SensorChoice::kMono));
  EXPECT_FALSE(run.map.metric);
  const Trajectory optimized = run.map.trajectory_optimized();
  EXPECT_EQ(optimized.posed(), drive().size());
  EXPECT_GT(run.map.trajectory_online.posed(), kFrames / 2u);
  const EvaluationResult result = judge(drive(), optimized, Alignment::kSim3);
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  EXPECT_LT(result.ape.error_m.rmse, 0.01 * result.path_m);
}

TEST(SlamOnAStreet, FillsInTheFramesBeforeItsSecondViewLater) {
  // The camera stands for four frames, then drives.
  Slam slam(small_options(), drive().calibration(Sensor::kMono));
  for (int i = 0; i < 12; ++i) {
    Frame frame = drive().frame(static_cast<std::size_t>(std::max(0, i - 3)), Sensor::kMono);
    frame.id = FrameId(i);
    frame.stamp_ns = i;
    slam.add_frame(frame);
  }
  const Map map = slam.finish();
  // The first frame is the origin; online, what was unknown at its time stays unknown.
  EXPECT_TRUE(map.trajectory_online.poses[0].T_world_body);
  for (const std::size_t i : {1, 2, 3}) EXPECT_FALSE(map.trajectory_online.poses[i].T_world_body);
  const Trajectory optimized = map.trajectory_optimized();
  ASSERT_EQ(optimized.posed(), 12u);
  const double length = optimized.poses[11].T_world_body->translation().norm();
  EXPECT_LT(optimized.poses[3].T_world_body->translation().norm(), 0.005 * length);
}

TEST(SlamOnAStreet, IsMetricWithOneCameraOfKnownHeight) {
  RunOptions options = run_as(SensorChoice::kMono);
  options.camera_height_m = kStreetHeight_m;
  const RunResult run = run_sequence(drive(), options);
  EXPECT_TRUE(run.map.metric);
  const Trajectory optimized = run.map.trajectory_optimized();
  EXPECT_EQ(optimized.posed(), drive().size());
  const EvaluationResult result = judge(drive(), optimized, Alignment::kScale);
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  EXPECT_NEAR(result.alignment.scale, 1, 0.03);  // sigma_relative of a single measurement
}

TEST(SlamOnAStreet, PosesEveryFrameWithDepth) {
  const StreetDataset dataset(10, 0, 0, true);
  const RunResult run = run_sequence(dataset, run_as(SensorChoice::kAuto));
  EXPECT_EQ(run.sensor, Sensor::kRgbd);
  const Trajectory optimized = run.map.trajectory_optimized();
  EXPECT_EQ(optimized.posed(), dataset.size());
  const EvaluationResult result = judge(dataset, optimized, Alignment::kOrigin);
  EXPECT_LT(result.ape.error_m.rmse, 0.01 * result.path_m);
}

TEST(SlamOnAStreet, GivesTheSameBitsTwiceAndWithAnyNumberOfThreads) {
  for (const SensorChoice sensor : {SensorChoice::kStereo, SensorChoice::kMono}) {
    RunOptions options = run_as(sensor);
    options.max_frames = 14;
    const int before = cv::getNumThreads();
    std::vector<std::string> bits;
    for (const int threads : {1, 2, 2}) {
      options.threads = threads;
      cv::setNumThreads(threads);
      bits.push_back(map_bits(run_sequence(drive(), options).map));
    }
    cv::setNumThreads(before);
    EXPECT_TRUE(bits[0] == bits[1]) << "1 and 2 threads differ";
    EXPECT_TRUE(bits[1] == bits[2]) << "two runs differ";
    EXPECT_GT(bits[0].size(), 1000u);
  }
}

TEST(SlamOnAStreet, RunsBesideAnotherAsIfAlone) {
  constexpr int kCount = 12;
  const auto calibration = drive().calibration(Sensor::kStereo);
  const auto frame = [](int i) {
    return drive().frame(static_cast<std::size_t>(i), Sensor::kStereo);
  };
  SlamOptions other_options = small_options();
  other_options.seed = 7;
  other_options.odometry.points.tracker.max_tracks = 150;
  const auto alone = [&](const SlamOptions& options, int first) {
    Slam slam(options, calibration);
    for (int i = first; i < kCount; ++i) slam.add_frame(frame(i));
    return map_bits(slam.finish());
  };
  Slam a(small_options(), calibration), b(other_options, calibration);
  for (int i = 0; i < kCount; ++i) {
    a.add_frame(frame(i));
    if (i >= 2) b.add_frame(frame(i));
  }
  EXPECT_TRUE(map_bits(a.finish()) == alone(small_options(), 0));
  EXPECT_TRUE(map_bits(b.finish()) == alone(other_options, 2));
}

TEST(SlamOnAStreet, CanBeLookedAtBetweenFramesWithoutChangingIt) {
  constexpr int kCount = 12;
  const auto calibration = drive().calibration(Sensor::kStereo);
  Slam quiet(small_options(), calibration), watched(small_options(), calibration);
  for (int i = 0; i < kCount; ++i) {
    const Frame frame = drive().frame(static_cast<std::size_t>(i), Sensor::kStereo);
    quiet.add_frame(frame);
    const FrameResult result = watched.add_frame(frame);
    const Map map = watched.snapshot();
    ASSERT_EQ(map.frames.size(), static_cast<std::size_t>(i + 1));
    EXPECT_EQ(map.trajectory_online.size(), static_cast<std::size_t>(i + 1));
    EXPECT_EQ(map.trajectory_optimized().posed(), static_cast<std::size_t>(i + 1));
    ASSERT_TRUE(result.T_map_cam);
    EXPECT_LT(
        distance_m(SE3(*map.trajectory_optimized().poses.back().T_world_body), *result.T_map_cam),
        1e-9);
    EXPECT_TRUE(map_bits(map) == map_bits(watched.snapshot()));
  }
  EXPECT_TRUE(map_bits(quiet.finish()) == map_bits(watched.finish()));
}

TEST(SlamOnAStreet, IsLostInTheDarkAndFindsItselfAgain) {
  const StreetDataset dataset(kFrames, 12, 15);
  std::vector<std::string> messages;
  RunInputs inputs;
  inputs.log = [&](LogLevel, const std::string& m) { messages.push_back(m); };
  const RunResult run = run_sequence(dataset, run_as(SensorChoice::kStereo), inputs);
  const Trajectory optimized = run.map.trajectory_optimized();
  for (int i = 0; i < kFrames; ++i) {
    const bool dark = i >= 12 && i < 15;
    EXPECT_EQ(optimized.poses[static_cast<std::size_t>(i)].T_world_body.has_value(), !dark) << i;
    EXPECT_EQ(run.map.trajectory_online.poses[static_cast<std::size_t>(i)].T_world_body.has_value(),
              !dark)
        << i;
  }
  EXPECT_THAT(messages, testing::Contains(testing::HasSubstr("frame 12 lost")));
  const EvaluationResult result = judge(dataset, optimized, Alignment::kOrigin);
  ASSERT_TRUE(result.outcome);
  EXPECT_EQ(result.lost_frames, (std::vector<int>{12, 13, 14}));
  EXPECT_LT(result.ape.error_m.rmse, 0.02 * result.path_m);  // the bridge adds its own error
}

TEST(SlamOnAStreet, GivesFramesBeforeTheLightNoPose) {
  const StreetDataset dataset(kFrames, 0, 3);
  for (const SensorChoice sensor : {SensorChoice::kMono, SensorChoice::kStereo}) {
    const RunResult run = run_sequence(dataset, run_as(sensor));
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_FALSE(run.map.trajectory_online.poses[i].T_world_body) << i;
      EXPECT_FALSE(run.map.trajectory_optimized().poses[i].T_world_body) << i;
    }
    EXPECT_TRUE(run.map.trajectory_online.poses[3].T_world_body);
    EXPECT_EQ(run.map.trajectory_optimized().posed(), static_cast<std::size_t>(kFrames - 3));
  }
}

TEST(SlamOnAStreet, MovesEvenlyFromOneKeyframeToTheNext) {
  // Keyframes are rare; the frames between them were posed against landmarks of poor depth at
  // first.
  RunOptions options = run_as(SensorChoice::kMono);
  options.slam.odometry.keyframe.max_flow_share = 0.12;
  const RunResult run = run_sequence(drive(), options);
  EXPECT_LT(run.map.keyframes.size(), drive().size() / 2);
  EXPECT_EQ(run.lens_k1, 0);
  const Trajectory optimized = run.map.trajectory_optimized(), truth = *drive().ground_truth();
  std::vector<double> units;  // of each step until the last keyframe
  const auto last = static_cast<std::size_t>(run.map.keyframes.back().frame.value());
  ASSERT_GT(last, drive().size() / 2);
  for (std::size_t i = 1; i <= last; ++i) {
    const auto step_m = [i](const Trajectory& t) {
      return (t.poses[i].T_world_body->translation() - t.poses[i - 1].T_world_body->translation())
          .norm();
    };
    units.push_back(step_m(optimized) / step_m(truth));
  }
  const auto [least, most] = std::minmax_element(units.begin(), units.end());
  EXPECT_LT(*most / *least, 1.04);
}

TEST(SlamOnAStreet, NotesALensThatItDoesNotCorrect) {
  RunOptions options = run_as(SensorChoice::kMono);
  options.slam.odometry.window.max_keyframes = 4;
  options.lens.min_sigmas = options.lens.min_effect = 0;  // everything is clear
  RunResult run = run_sequence(drive(), options);
  EXPECT_EQ(run.lens_k1, 0);  // one stretch of motion proves nothing
  const auto notes_distortion =
      testing::Contains(testing::Field(&DataNote::cause, NoteCause::kDistortion));
  EXPECT_THAT(run.notes, notes_distortion);
  options.lens.enabled = false;
  run = run_sequence(drive(), options);
  EXPECT_THAT(run.notes, testing::Not(notes_distortion));
}

/// Eight degrees of turning on the spot are a tenth of the image's width, and no parallax.
TEST(SlamOnAStreet, NeedsNoKeyframesToRotateWhereItsRotationIsRemoved) {
  std::vector<Frame> frames;
  for (int i = 0; i < 20; ++i) {
    const SE3 T_world_left = pose({0, deg_to_rad(0.4 * i), 0}, {0, -kStreetHeight_m, 0});
    Frame frame;
    frame.id = FrameId(i);
    frame.stamp_ns = i;
    frame.image = render(street_camera(), T_world_left, street(), 2).grey;
    frame.right = render(street_camera(), T_world_left * pose({0, 0, 0}, {kStreetBaseline_m, 0, 0}),
                         street(), 2)
                      .grey;
    frames.push_back(frame);
  }
  const auto keyframes = [&](bool derotated) {
    SlamOptions options = small_options();
    options.odometry.keyframe.derotated = derotated;
    Slam slam(options, drive().calibration(Sensor::kStereo));
    for (const Frame& frame : frames) slam.add_frame(frame);
    const Map map = slam.finish();
    EXPECT_EQ(map.trajectory_optimized().posed(), frames.size());
    return map.keyframes.size();
  };
  EXPECT_GE(keyframes(false), 2u);
  EXPECT_EQ(keyframes(true), 1u);
}

TEST(SlamOnAStreet, GoesOnWithOneCameraAfterAJumpToAKnownPlace) {
  // Frames 0 to 23, then from 8 on again: the new run takes place and unit from the map.
  Slam slam(small_options(), drive().calibration(Sensor::kMono));
  std::vector<std::optional<SE3>> online;
  for (int i = 0; i < kFrames + 14; ++i) {
    const std::size_t source = i < kFrames ? i : i - kFrames + 8;
    Frame frame = drive().frame(source, Sensor::kMono);
    frame.id = FrameId(i);
    frame.stamp_ns = 100000000LL * i;
    online.push_back(slam.add_frame(frame).T_map_cam);
  }
  const Trajectory optimized = slam.finish().trajectory_optimized();
  const double path = optimized.poses[kFrames - 1].T_world_body->translation().norm();
  for (int i = kFrames; i < kFrames + 14; ++i) {
    ASSERT_TRUE(online[i]) << i;
    const auto& again = optimized.poses[i].T_world_body;
    ASSERT_TRUE(again) << i;
    const Eigen::Vector3d first = optimized.poses[i - kFrames + 8].T_world_body->translation();
    // The unit comes from two recognized frames: it is known, and claimed, to a tenth.
    EXPECT_LT((again->translation() - first).norm(), 0.1 * path) << i;
  }
}

TEST(SlamOnAStreet, BeginsANewComponentWhenNothingIsKnownAgain) {
  // The second half is another street: mirrored pictures.
  SlamOptions options = small_options();
  options.max_lost_frames = 2;
  Slam slam(options, drive().calibration(Sensor::kStereo));
  for (int i = 0; i < 16; ++i) {
    Frame frame = drive().frame(static_cast<std::size_t>(i), Sensor::kStereo);
    frame.image = frame.image.clone(), frame.right = frame.right.clone();
    if (i >= 8) {
      cv::flip(frame.image, frame.image, 0);
      cv::flip(frame.right, frame.right, 0);
    }
    slam.add_frame(frame);
  }
  const Map map = slam.finish();
  int components = 0;
  for (const Place& place : map.place_graph.places)
    components = std::max(components, place.component + 1);
  EXPECT_EQ(components, 2);
  const Trajectory optimized = map.trajectory_optimized();
  EXPECT_EQ(optimized.posed(), 8u);
  EXPECT_GT(std::count_if(map.frames.begin(), map.frames.end(),
                          [](const FrameRecord& f) { return f.T_keyframe_frame.has_value(); }),
            12);
}

/// The drive as a wheel sensor tells it: 1 % too long, turning 0.02 degrees a frame too much, and a
/// burst of slip in which the wheels go three times as far.
std::shared_ptr<const MeasuredMotion> slipping_wheels(int slip_begin, int slip_end) {
  std::vector<MotionStep> steps;
  for (int i = 0; i + 1 < kFrames; ++i) {
    const SE3 T = street_T_world_cam(i).inverse() * street_T_world_cam(i + 1);
    const double factor = i >= slip_begin && i < slip_end ? 3 : 1.01;
    const SE3 measured(T.rotation() * SO3::exp({0, deg_to_rad(0.02), 0}), factor * T.translation());
    steps.push_back({drive().stamp_ns(static_cast<std::size_t>(i)),
                     drive().stamp_ns(static_cast<std::size_t>(i) + 1), measured,
                     MotionNoise().covariance(measured)});
  }
  return std::make_shared<const MeasuredMotion>(std::move(steps));
}

TEST(SlamOnAStreet, TakesItsUnitFromMeasuredMotionAndDoesNotSlipWithIt) {
  SlamOptions options = small_options();
  options.odometry.keyframe.min_tracked_share = 0.85;  // the unit takes five ways
  Slam slam(options, drive().calibration(Sensor::kMono), {.motion = slipping_wheels(14, 16)});
  for (int i = 0; i < kFrames; ++i)
    slam.add_frame(drive().frame(static_cast<std::size_t>(i), Sensor::kMono));
  const Map map = slam.finish();
  EXPECT_TRUE(map.metric);
  const EvaluationResult result = judge(drive(), map.trajectory_optimized(), Alignment::kScale);
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  // The wheels alone make the way 17 % too long.
  EXPECT_NEAR(result.alignment.scale, 1, 0.04);
  EXPECT_LT(result.ape.error_m.rmse, 0.02 * result.path_m);
}

TEST(SlamOnAStreet, IsNotLedAstrayBySlipWithAStereoPair) {
  Slam slam(small_options(), drive().calibration(Sensor::kStereo),
            {.motion = slipping_wheels(10, 13)});
  for (int i = 0; i < kFrames; ++i)
    slam.add_frame(drive().frame(static_cast<std::size_t>(i), Sensor::kStereo));
  const Trajectory optimized = slam.finish().trajectory_optimized();
  const EvaluationResult result = judge(drive(), optimized, Alignment::kOrigin);
  EXPECT_LT(result.ape.error_m.rmse, 0.01 * result.path_m);
}

TEST(SlamOnAStreet, IsCarriedThroughTheDarkByMeasuredMotion) {
  // Dark for so long that nothing is known again: the pictures behind are mirrored.
  SlamOptions options = small_options();
  options.max_lost_frames = 2;
  Slam slam(options, drive().calibration(Sensor::kStereo), {.motion = slipping_wheels(0, 0)});
  for (int i = 0; i < kFrames; ++i) {
    Frame frame = drive().frame(static_cast<std::size_t>(i), Sensor::kStereo);
    frame.image = frame.image.clone(), frame.right = frame.right.clone();
    if (i >= 10 && i < 15) frame.image.setTo(0), frame.right.setTo(0);
    if (i >= 15) cv::flip(frame.image, frame.image, 0), cv::flip(frame.right, frame.right, 0);
    slam.add_frame(frame);
  }
  const Map map = slam.finish();
  for (const Place& place : map.place_graph.places) EXPECT_EQ(place.component, 0);
  const Trajectory optimized = map.trajectory_optimized();
  EXPECT_EQ(optimized.posed(), static_cast<std::size_t>(kFrames));
  for (int i = 10; i < 16; ++i) {
    ASSERT_TRUE(optimized.poses[i].T_world_body) << i;
    const SE3 truth = street_T_world_cam(0).inverse() * street_T_world_cam(i);
    EXPECT_LT(distance_m(SE3(*optimized.poses[i].T_world_body), truth), 0.1) << i;
  }
}

TEST(SlamOnAStreet, RefusesFramesThatBreakTheContract) {
  Slam slam(small_options(), drive().calibration(Sensor::kStereo));
  const auto refusal = [&](const Frame& frame) -> std::string {
    try {
      slam.add_frame(frame);
    } catch (const ArgumentError& error) {
      return error.what();
    }
    return "nothing was thrown";
  };
  const Frame first = drive().frame(0, Sensor::kStereo);
  Frame wrong = first;
  wrong.image = wrong.image.colRange(0, 300);
  EXPECT_THAT(refusal(wrong), testing::HasSubstr("frame 0: grey image of 448x280 needed"));
  wrong.image = Image(280, 448, CV_8UC3);
  EXPECT_THAT(refusal(wrong), testing::HasSubstr("grey image"));
  wrong = first;
  wrong.right = wrong.right.colRange(0, 300);
  EXPECT_THAT(refusal(wrong), testing::HasSubstr("right image"));
  slam.add_frame(first);
  EXPECT_THAT(refusal(first), testing::HasSubstr("must increase"));
  slam.finish();
  EXPECT_THAT(refusal(drive().frame(1, Sensor::kStereo)), testing::HasSubstr("after finish()"));
}

TEST(RunSequence, RefusesASensorThatTheSequenceLacksAndFramesBeyondItsEnd) {
  EXPECT_THROW((void)run_sequence(drive(), run_as(SensorChoice::kRgbd)), ArgumentError);
  RunOptions options = run_as(SensorChoice::kAuto);
  options.first_frame = kFrames;
  EXPECT_THROW((void)run_sequence(drive(), options), ArgumentError);
}

TEST(RunSequence, RunsAPartAndReportsItsProgress) {
  RunOptions options = run_as(SensorChoice::kAuto);
  options.first_frame = 3;
  options.max_frames = 4;
  std::vector<std::size_t> done;
  RunInputs inputs;
  inputs.progress = [&](std::size_t d, std::size_t total, const FrameResult& result) {
    EXPECT_EQ(total, 4u);
    EXPECT_EQ(result.frame, FrameId(2 + d));
    done.push_back(d);
  };
  const RunResult run = run_sequence(drive(), options, inputs);
  EXPECT_EQ(done, (std::vector<std::size_t>{1, 2, 3, 4}));
  ASSERT_EQ(run.map.frames.size(), 4u);
  EXPECT_EQ(run.map.frames.front().frame, FrameId(3));
}

}  // namespace slam_test
}  // namespace placegraph
