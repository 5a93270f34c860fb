#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/odometry/odometry_parts.h>

#include "tests/support/scenes/street.h"

namespace placegraph {
namespace odometry_parts_test {

using namespace test;

Calibration camera(Sensor sensor, std::optional<double> height_m = {}) {
  Calibration calibration;
  calibration.camera = street_camera();
  calibration.camera_height_m = height_m;
  if (sensor == Sensor::kStereo) calibration.baseline_m = kStreetBaseline_m;
  if (sensor == Sensor::kRgbd) calibration.depth = DepthCamera{street_camera(), SE3(), 0.005};
  return calibration;
}
OdometryOptions cues(const std::string& names) {
  OdometryOptions options;
  options.cues = names;
  return options;
}

TEST(OdometryParts, SensorsThatMeasureLengthsAreMetricFromTheStart) {
  EXPECT_EQ(scale_at_start(cues("points"), camera(Sensor::kStereo), false, false), Scale::kMetric);
  EXPECT_EQ(scale_at_start(cues("points"), camera(Sensor::kRgbd), true, true), Scale::kMetric);
  EXPECT_EQ(scale_at_start(cues("plane"), camera(Sensor::kMono, 1.6), false, false),
            Scale::kMetric);
}

TEST(OdometryParts, AMonocularCameraTakesItsScaleFromTheMapOrGuessesIt) {
  const Calibration mono = camera(Sensor::kMono, 1.6);
  EXPECT_EQ(scale_at_start(cues("points,plane"), mono, false, false), Scale::kArbitrary);
  EXPECT_EQ(scale_at_start(cues("points,plane"), mono, true, false), Scale::kFromMap);
  EXPECT_EQ(scale_at_start(cues("points,plane"), mono, false, true), Scale::kGuessed);
}

TEST(OdometryParts, TheStageTellsHowFramesAreTracked) {
  StageTimes times;
  const auto stage = [&](const std::string& names, const Calibration& calibration) {
    return std::string(make_tracker(cues(names), calibration, 1, {}, times).tracker->stage());
  };
  EXPECT_EQ(stage("points,plane", camera(Sensor::kMono)), "frame pose");
  EXPECT_EQ(stage("lines", camera(Sensor::kMono)), "frame pose");
  EXPECT_EQ(stage("points,direct", camera(Sensor::kStereo)), "frame pose");
  EXPECT_EQ(stage("plane", camera(Sensor::kStereo)), "surfaces");
}

TEST(OdometryParts, EachCueIsThereOnlyIfItIsNamed) {
  StageTimes times;
  const auto parts = [&](const std::string& names) {
    return make_tracker(cues(names), camera(Sensor::kStereo), 1, {}, times);
  };
  EXPECT_EQ(parts("points").tracker->lines(), nullptr);
  EXPECT_EQ(parts("points").tracker->manhattan(), nullptr);
  EXPECT_FALSE(parts("points").tracker->corrects_rotations());
  const auto all = parts("points,lines,manhattan");
  EXPECT_NE(all.tracker->lines(), nullptr);
  EXPECT_NE(all.tracker->manhattan(), nullptr);
  EXPECT_TRUE(all.tracker->corrects_rotations());
  Assumptions none;
  none.manhattan_frame = false;
  all.tracker->assume(none);
  EXPECT_EQ(all.tracker->manhattan(), nullptr);
  all.tracker->assume(std::nullopt);
  EXPECT_NE(all.tracker->manhattan(), nullptr);
}

TEST(OdometryParts, CuesThatNeedAnotherSensorAreRefused) {
  StageTimes times;
  EXPECT_THROW(make_tracker(cues("plane"), camera(Sensor::kMono), 1, {}, times), ArgumentError);
  EXPECT_THROW(make_tracker(cues("points,direct"), camera(Sensor::kMono), 1, {}, times),
               ArgumentError);
  EXPECT_NO_THROW(make_tracker(cues("points,direct"), camera(Sensor::kMono, 1.6), 1, {}, times));
}

}  // namespace odometry_parts_test
}  // namespace placegraph
