#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/eval/errors/relative_error.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>

#include "tests/support/trajectories.h"

namespace placegraph {
namespace relative_error_test {

using test::isometry;
using ::testing::HasSubstr;

// A straight line of steps of 1 m along z at 10 Hz, turning by a degree about y every frame. The
// estimate is `scale` times as long.
std::vector<FramePair> line(int frames, double scale = 1.1) {
  std::vector<FramePair> pairs;
  for (int i = 0; i < frames; ++i) {
    FramePair pair;
    pair.frame = i;
    pair.stamp_ns = i * 100'000'000LL;
    pair.T_world_truth = isometry({0, i * kRadPerDeg, 0}, {0, 0, double(i)});
    pair.T_world_estimate = isometry({0, i * kRadPerDeg, 0}, {0, 0, scale * i});
    pairs.push_back(pair);
  }
  return pairs;
}

RelativeErrors over(const std::vector<FramePair>& pairs, const char* delta,
                    StepPairs choice = StepPairs::kConsecutive) {
  return relative_errors(pairs, true, parse_delta(delta), choice);
}

TEST(Delta, IsReadWithItsUnit) {
  EXPECT_EQ(parse_delta("10"), (Delta{10, Delta::Unit::kFrames}));
  EXPECT_EQ(parse_delta("10f"), (Delta{10, Delta::Unit::kFrames}));
  EXPECT_EQ(parse_delta("0.5s"), (Delta{0.5, Delta::Unit::kSeconds}));
  EXPECT_EQ(parse_delta("5m"), (Delta{5, Delta::Unit::kMetres}));
  EXPECT_EQ(parse_delta("1e1deg"), (Delta{10, Delta::Unit::kDegrees}));
  EXPECT_NEAR(parse_delta("0.2rad").value, 11.459156, 1e-6);
  EXPECT_EQ(to_string(parse_deltas("1s,10f,5m,10deg")), "1s,10f,5m,10deg");
  EXPECT_TRUE(parse_deltas("").empty());
}

TEST(Delta, IsRefusedInOneLineThatSaysWhatThereIs) {
  for (const char* text : {"0s", "-1m", "nan", "inf", "1.5f", "1 s", "s", "", "5km", "1e12m"}) {
    try {
      (void)parse_delta(text);
      ADD_FAILURE() << text;
    } catch (const ArgumentError& error) {
      EXPECT_THAT(error.what(), HasSubstr(std::string("delta '") + text + "'"));
      EXPECT_THAT(error.what(), HasSubstr("10deg"));
    }
  }
}

TEST(RelativeErrors, OfAScaleAreExactOverEveryUnit) {
  const std::vector<FramePair> pairs = line(101);
  for (const char* delta : {"10f", "1s", "10m", "10deg"}) {
    SCOPED_TRACE(delta);
    const RelativeErrors steps = over(pairs, delta);
    ASSERT_TRUE(steps.outcome) << steps.outcome.reason;
    ASSERT_EQ(steps.errors.size(), 10u);
    EXPECT_EQ(steps.errors[3].first, 30);
    EXPECT_EQ(steps.errors[3].last, 40);
    EXPECT_NEAR(steps.translation_m.rmse, 1, 1e-12);
    EXPECT_NEAR(steps.length_m.mean, 1, 1e-12);
    EXPECT_NEAR(steps.rotation_deg.max, 0, 1e-12);
    EXPECT_NEAR(steps.full.rmse, 1, 1e-12);
    EXPECT_EQ(over(pairs, delta, StepPairs::kAll).errors.size(), 91u);
  }
}

TEST(RelativeErrors, EndAtTheFirstPoseAtOrBeyondADistance) {
  // Steps of 1 m: 2.5 m are reached after three of them.
  const RelativeErrors steps = over(line(11), "2.5m");
  ASSERT_EQ(steps.errors.size(), 3u);
  EXPECT_EQ(steps.errors[0].last, 3);
  EXPECT_EQ(steps.errors[2].last, 9);
  // Ten tenths are a metre, although their sum in binary is less.
  std::vector<FramePair> tenths = line(21);
  for (FramePair& pair : tenths) pair.T_world_truth.translation() *= 0.1;
  EXPECT_EQ(over(tenths, "1m").errors.at(0).last, 10);
}

TEST(RelativeErrors, EndAtThePoseNearestInTime) {
  std::vector<FramePair> pairs = line(30);
  for (FramePair& pair : pairs) pair.stamp_ns += (pair.frame % 3 - 1) * 20'000'000LL;
  const RelativeErrors steps = over(pairs, "1s", StepPairs::kAll);
  ASSERT_TRUE(steps.outcome);
  for (const RelativeError& step : steps.errors) {
    const double seconds = static_cast<double>(pairs[std::size_t(step.last)].stamp_ns -
                                               pairs[std::size_t(step.first)].stamp_ns) *
                           1e-9;
    EXPECT_NEAR(seconds, 1, 0.05);
  }
}

TEST(RelativeErrors, DoNotDependOnTheEpochOfTheStamps) {
  // Steps of 0.25 s end between two poses, which are equally near.
  for (const char* delta : {"0.25s", "0.35s"})
    for (const StepPairs choice : {StepPairs::kConsecutive, StepPairs::kAll}) {
      std::vector<FramePair> pairs = line(60);
      const RelativeErrors at_zero = over(pairs, delta, choice);
      for (FramePair& pair : pairs) pair.stamp_ns += 1'700'000'000'123'456'789;
      const RelativeErrors since_1970 = over(pairs, delta, choice);
      ASSERT_EQ(at_zero.errors.size(), since_1970.errors.size());
      for (std::size_t i = 0; i < at_zero.errors.size(); ++i)
        EXPECT_EQ(at_zero.errors[i].last, since_1970.errors[i].last);
    }
}

TEST(RelativeErrors, OfStepsShorterThanTheSpacingAreNone) {
  const RelativeErrors errors = over(line(60), "0.01s");
  EXPECT_FALSE(errors.outcome);
  EXPECT_EQ(errors.outcome.reason,
            "steps of 0.01 s are shorter than half the spacing of the poses, 0.1 s");
}

TEST(RelativeErrors, NeverCrossAGap) {
  std::vector<FramePair> lost = line(100);
  for (int i = 40; i < 45; ++i) lost[std::size_t(i)].T_world_estimate.reset();
  std::vector<FramePair> hole = line(100);
  hole.erase(hole.begin() + 40, hole.begin() + 45);
  for (const std::vector<FramePair>& pairs : {lost, hole})
    for (const char* delta : {"1f", "10f", "1s", "10m", "10deg"})
      for (const StepPairs choice : {StepPairs::kConsecutive, StepPairs::kAll}) {
        SCOPED_TRACE(delta);
        const RelativeErrors steps = over(pairs, delta, choice);
        ASSERT_TRUE(steps.outcome);
        EXPECT_EQ(steps.gaps, 1);
        for (const RelativeError& step : steps.errors) {
          const int first = pairs[std::size_t(step.first)].frame;
          const int last = pairs[std::size_t(step.last)].frame;
          EXPECT_FALSE(first < 40 && last >= 40) << first << " to " << last;
        }
      }
  EXPECT_EQ(over(hole, "1f").errors.size(), 93u);
}

TEST(RelativeErrors, OfKeyframesAtUnevenTimesHaveNoGap) {
  std::vector<FramePair> pairs = line(100);
  std::int64_t stamp_ns = 0;
  for (FramePair& pair : pairs) pair.stamp_ns = stamp_ns += (1 + pair.frame % 4) * 250'000'000LL;
  EXPECT_EQ(over(pairs, "1f").errors.size(), 99u);
}

TEST(RelativeErrors, SayThatTheDriveIsTooShort) {
  EXPECT_EQ(over(line(11), "100m").outcome.reason,
            "the drive of 10 m is too short for steps of 100 m");
  EXPECT_EQ(over(line(11), "1000f").outcome.reason,
            "the drive of 10 frames is too short for steps of 1000 frames");
  EXPECT_THAT(over(line(11), "90deg").outcome.reason, HasSubstr("10 deg"));
  EXPECT_THAT(over(line(11), "60s").outcome.reason, HasSubstr("1 s is too short"));
  const RelativeErrors untimed = relative_errors(line(11), false, parse_delta("1s"));
  EXPECT_EQ(untimed.outcome.code, Outcome::Code::kInconsistent);
  std::vector<FramePair> pieces = line(30);
  for (std::size_t i = 0; i < pieces.size(); i += 6) pieces[i].T_world_estimate.reset();
  EXPECT_THAT(over(pieces, "10m").outcome.reason, HasSubstr("between gaps"));
}

TEST(RelativeErrors, TakeTheScaleOfTheAlignment) {
  const RelativeErrors steps =
      relative_errors(line(20, 2.0), true, {}, StepPairs::kConsecutive, 0.5);
  EXPECT_NEAR(steps.translation_m.max, 0, 1e-12);
}

TEST(Quantile, IsThatOfNumpy) {
  const std::vector<double> sorted = {1, 2, 4, 8};
  EXPECT_DOUBLE_EQ(quantile(sorted, 0), 1);
  EXPECT_DOUBLE_EQ(quantile(sorted, 0.5), 3);
  EXPECT_DOUBLE_EQ(quantile(sorted, 0.75), 5);
  EXPECT_DOUBLE_EQ(quantile(sorted, 0.9), 6.8);
  EXPECT_DOUBLE_EQ(quantile(sorted, 1), 8);
  EXPECT_THROW((void)quantile({}, 0.5), ArgumentError);
  EXPECT_THROW((void)quantile(sorted, 1.5), ArgumentError);
}

TEST(Statistics, HaveTheQuantilesOfTheSortedList) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Random random(seed);
    std::vector<double> errors;
    for (int i = 0; i < 1 + int(seed * seed % 997); ++i)
      errors.push_back(seed % 3 == 0 ? std::floor(random.uniform(0, 5)) : random.normal());
    const Statistics s = statistics_of(errors);
    std::sort(errors.begin(), errors.end());
    EXPECT_EQ(s.median, quantile(errors, 0.5)) << seed;
    EXPECT_EQ(s.p75, quantile(errors, 0.75)) << seed;
    EXPECT_EQ(s.p90, quantile(errors, 0.9)) << seed;
    EXPECT_EQ(s.p95, quantile(errors, 0.95)) << seed;
    EXPECT_EQ(s.p99, quantile(errors, 0.99)) << seed;
    EXPECT_EQ(s.min, errors.front());
    EXPECT_EQ(s.max, errors.back());
  }
}

/// Two poses a metre apart along x, and an error at the end of the step, in the world.
RelativeErrors with_error_at_end(const Eigen::Vector3d& world_rotation, const Eigen::Vector3d& up) {
  std::vector<FramePair> pairs(2);
  pairs[0].T_world_truth = isometry({0.3, 0.2, -1}, {0, 0, 0});
  pairs[1].T_world_truth = isometry({-0.4, 0.1, 2}, {1, 0, 0});
  pairs[1].stamp_ns = 100'000'000;
  for (FramePair& pair : pairs) pair.T_world_estimate = pair.T_world_truth;
  pairs[1].T_world_estimate->linear() =
      isometry(world_rotation, {0, 0, 0}).linear() * pairs[1].T_world_truth.linear();
  return relative_errors(pairs, true, {}, StepPairs::kConsecutive, 1, up);
}

TEST(RelativeErrors, OfTheHeadingAloneHaveNoInclinationAndTheOtherWayRound) {
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d up = Eigen::Vector3d::Unit(axis);
    for (const double deg : {-170.0, -3.0, 0.0, 2.0, 90.0}) {
      SCOPED_TRACE(std::to_string(deg) + " deg about axis " + std::to_string(axis));
      const RelativeErrors turned = with_error_at_end(deg * kRadPerDeg * up, up);
      ASSERT_TRUE(turned.has_vertical);
      EXPECT_NEAR(turned.errors[0].heading_deg, std::abs(deg), 1e-9);
      EXPECT_NEAR(turned.errors[0].inclination_deg, 0, 1e-9);
      const Eigen::Vector3d level =
          (Eigen::Vector3d::Unit((axis + 1) % 3) - 2 * Eigen::Vector3d::Unit((axis + 2) % 3))
              .normalized();
      const RelativeErrors tilted = with_error_at_end(deg * kRadPerDeg * level, up);
      EXPECT_NEAR(tilted.errors[0].heading_deg, 0, 1e-9);
      EXPECT_NEAR(tilted.errors[0].inclination_deg, std::abs(deg), 1e-9);
      EXPECT_NEAR(tilted.errors[0].rotation_deg, std::abs(deg), 1e-9);
    }
  }
  // Both: a tilt of 0.3 rad, then a turn of 0.4 about the vertical: cos(angle / 2) is the product.
  const Eigen::Matrix3d both =
      (Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitZ()) *
       Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  const Eigen::AngleAxisd whole(both);
  const RelativeErrors errors =
      with_error_at_end(whole.angle() * whole.axis(), Eigen::Vector3d::UnitZ());
  EXPECT_NEAR(errors.heading_deg.rmse, rad_to_deg(0.4), 1e-9);
  EXPECT_NEAR(errors.inclination_deg.rmse, rad_to_deg(0.3), 1e-9);
  EXPECT_NEAR(errors.rotation_deg.rmse, rad_to_deg(2 * std::acos(std::cos(0.2) * std::cos(0.15))),
              1e-9);
}

}  // namespace relative_error_test
}  // namespace placegraph
