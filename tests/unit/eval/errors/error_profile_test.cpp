#include <gtest/gtest.h>
#include <placegraph/eval/trajectory/evaluate.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>

#include "tests/support/trajectories.h"

namespace placegraph {
namespace error_profile_test {

using test::isometry;

EvaluationOptions unaligned() {
  EvaluationOptions options;
  options.alignment = Alignment::kNone;
  return options;
}

/// A circle in the plane of x and z, as a camera that looks ahead drives it.
Trajectory circle(int frames, double radius_m = 20) {
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < frames; ++i) {
    const double a = 2 * 3.141592653589793 * i / frames;
    poses.push_back(isometry({0, a, 0}, {-radius_m * std::cos(a), 0, radius_m * std::sin(a)}));
  }
  return test::trajectory_of(poses);
}

TEST(ErrorComponents, SplitAnErrorByTheDirectionOfThePath) {
  const Trajectory truth = circle(400);
  // Ahead by 0.3 m, to the right by 0.2 m, down by 0.1 m: x right, y down, z ahead.
  Trajectory estimate = truth;
  for (StampedPose& pose : estimate.poses)
    pose.T_world_body = *pose.T_world_body * isometry({0, 0, 0}, {0.2, 0.1, 0.3});
  const EvaluationResult result = evaluate(truth, estimate, unaligned());
  ASSERT_TRUE(result.components.outcome) << result.components.outcome.reason;
  EXPECT_EQ(result.components.vertical, "y (estimated)");
  EXPECT_NEAR(result.components.along_m.mean, 0.3, 0.01);
  EXPECT_NEAR(std::abs(result.components.across_m.mean), 0.2, 0.01);
  EXPECT_NEAR(result.components.up_m.mean, 0.1, 1e-12);
  EXPECT_LT(result.components.along_m.std_dev, 0.02);
  for (const Eigen::Vector3d& error : result.components.errors_m)
    EXPECT_NEAR(error.norm(), std::sqrt(0.14), 1e-12);
}

TEST(ErrorComponents, OfADriveThatFirstStandsTakeItsFirstDirection) {
  Trajectory truth = circle(200);
  for (std::size_t i = 0; i < 20; ++i) truth.poses[i].T_world_body = truth.poses[20].T_world_body;
  Trajectory estimate = truth;
  for (StampedPose& pose : estimate.poses)
    pose.T_world_body->translation() +=
        0.5 * truth.poses[20].T_world_body->linear().col(2);
  const EvaluationResult result = evaluate(truth, estimate, unaligned());
  ASSERT_TRUE(result.components.outcome);
  EXPECT_NEAR(result.components.errors_m.front()[0], 0.5, 0.01);
}

TEST(ErrorPart, IsThePartInThePlaneOrAlongTheAxis) {
  const Trajectory truth = circle(100);
  Trajectory estimate = truth;
  for (StampedPose& pose : estimate.poses)
    pose.T_world_body = isometry({0, 0, 0}, {3, 4, 12}) * *pose.T_world_body;
  const auto rmse = [&](ErrorPart part) {
    EvaluationOptions options = unaligned();
    options.part = part;
    return evaluate(truth, estimate, options).ape.error_m.rmse;
  };
  EXPECT_NEAR(rmse(ErrorPart::kSpace), 13, 1e-12);
  EXPECT_NEAR(rmse(ErrorPart::kXy), 5, 1e-12);
  EXPECT_NEAR(rmse(ErrorPart::kXz), std::sqrt(153.0), 1e-12);
  EXPECT_NEAR(rmse(ErrorPart::kFitted), std::sqrt(153.0), 1e-9);
  EXPECT_NEAR(rmse(ErrorPart::kYz), std::sqrt(160.0), 1e-12);
  EXPECT_NEAR(rmse(ErrorPart::kX), 3, 1e-12);
  EXPECT_NEAR(rmse(ErrorPart::kY), 4, 1e-12);
  EXPECT_NEAR(rmse(ErrorPart::kZ), 12, 1e-12);
}

TEST(ErrorPart, JudgesTheRotationAboutThePlanesNormal) {
  const Trajectory truth = circle(100);
  Trajectory estimate = truth;
  for (StampedPose& pose : estimate.poses)  // heading 2 deg, roll 30 deg
    pose.T_world_body->linear() =
        isometry({0, 2 * kRadPerDeg, 0}, {0, 0, 0}).linear() * pose.T_world_body->linear();
  EvaluationOptions options = unaligned();
  options.part = ErrorPart::kXz;
  EXPECT_NEAR(evaluate(truth, estimate, options).ape.rotation_deg.mean, 2, 1e-9);
  options.part = ErrorPart::kXy;
  EXPECT_NEAR(evaluate(truth, estimate, options).ape.rotation_deg.mean, 0, 1e-9);
}

TEST(AbsoluteRotation, IsTheAngleOfThePoseError) {
  const Trajectory truth = circle(100);
  Trajectory estimate = truth;
  for (std::size_t i = 0; i < estimate.size(); ++i)
    estimate.poses[i].T_world_body->linear() =
        estimate.poses[i].T_world_body->linear() *
        isometry({(i % 2 ? 3 : 1) * kRadPerDeg, 0, 0}, {0, 0, 0}).linear();
  const EvaluationResult result = evaluate(truth, estimate, unaligned());
  EXPECT_NEAR(result.ape.rotation_deg.mean, 2, 1e-9);
  EXPECT_NEAR(result.ape.rotation_deg.std_dev, 1, 1e-9);
  EXPECT_NEAR(result.ape.rotation_deg.rmse, std::sqrt(5.0), 1e-9);
  EXPECT_NEAR(result.ape.rotation_deg.sse, 500, 1e-6);
  // |E - I| of a rotation by a is sqrt(8) sin(a / 2).
  EXPECT_NEAR(result.ape.full.max, std::sqrt(8.0) * std::sin(1.5 * kRadPerDeg), 1e-9);
}

TEST(ErrorProfile, FindsTheWorstHundredth) {
  const Trajectory truth = test::winding_drive(1000);
  Trajectory estimate = truth;
  for (std::size_t i = 400; i < 405; ++i)
    estimate.poses[i].T_world_body->translation() += Eigen::Vector3d(0, 2, 0);
  for (std::size_t i = 700; i < 705; ++i)
    estimate.poses[i].T_world_body->translation() += Eigen::Vector3d(0, 5, 0);
  const EvaluationResult result = evaluate(truth, estimate, unaligned());
  ASSERT_EQ(result.profile.worst.size(), 2u);
  EXPECT_EQ(result.profile.worst[0].first_frame, 700);
  EXPECT_EQ(result.profile.worst[0].last_frame, 704);
  EXPECT_NEAR(result.profile.worst[0].largest, 5, 1e-12);
  EXPECT_NEAR(result.profile.worst[0].first_s, 70, 1e-9);
  EXPECT_EQ(result.profile.worst[1].first_frame, 400);
  EXPECT_EQ(result.profile.worst_steps.front().first_frame, 699);
}

TEST(ErrorProfile, GroupsCoverEveryFrameOnce) {
  Random random(4);
  const Trajectory truth = test::winding_drive(500);
  const EvaluationResult result = evaluate(truth, test::drifting(truth, 0.01, 0.001, random));
  int frames = 0;
  double squares = 0;
  for (const ErrorGroup& group : result.profile.by_distance) {
    frames += group.frames;
    squares += group.frames * group.ate_rmse_m * group.ate_rmse_m;
    EXPECT_LT(group.from, group.to);
  }
  EXPECT_EQ(frames, 500);
  EXPECT_NEAR(std::sqrt(squares / frames), result.ape.error_m.rmse, 1e-9);
  for (const auto& groups : {result.profile.by_speed, result.profile.by_turning}) {
    frames = 0;
    for (const ErrorGroup& group : groups) frames += group.frames;
    EXPECT_EQ(frames, 499);  // a step begins at every frame but the last
    EXPECT_GE(groups.size(), 3u);
    EXPECT_LE(groups.size(), 12u);
  }
}

/// The shares below bounds by the definition, frame by frame.
void expect_shares(const EvaluationResult& result, const ShareBelow& share) {
  std::vector<bool> below;
  for (const FramePair& pair : result.aligned_pairs) {
    bool is_below = pair.T_world_estimate.has_value();
    if (is_below) {
      const Eigen::Isometry3d error = pair.T_world_truth.inverse() * *pair.T_world_estimate;
      const double value = share.bound.of_rotation ? rad_to_deg(rotation_angle(error.linear()))
                                                   : error.translation().norm();
      is_below = value < share.bound.value;
    }
    below.push_back(is_below);
  }
  double path_m = 0;
  for (std::size_t i = 1; i < below.size(); ++i)
    if (below[i - 1] && below[i]) path_m += result.travelled_m[i] - result.travelled_m[i - 1];
  const auto count = static_cast<double>(std::ranges::count(below, true));
  EXPECT_NEAR(share.frames, count / static_cast<double>(result.judged), 1e-12);
  EXPECT_NEAR(share.path, path_m / result.path_m, 1e-12);
}

TEST(SharesBelow, CountWhatIsMissingAsNotBelow) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Trajectory truth = test::winding_drive(400);
    Trajectory estimate = test::drifting(truth, 0.02, 0.001, random);
    for (StampedPose& pose : estimate.poses)
      if (random.uniform(0, 1) < 0.1) pose.T_world_body.reset();
    EvaluationOptions options;
    options.below = parse_error_bounds("0.05m,0.2m,1m,100m,0.5deg,179deg");
    const EvaluationResult result = evaluate(truth, estimate, options);
    ASSERT_EQ(result.below.size(), 6u);
    for (const ShareBelow& share : result.below) {
      ASSERT_TRUE(share.outcome);
      expect_shares(result, share);
      EXPECT_LE(share.path, share.frames + 2.0 / 400);  // a lost frame takes both of its steps
    }
    for (int k = 1; k < 4; ++k) {  // a larger bound has no smaller share
      EXPECT_LE(result.below[std::size_t(k - 1)].frames, result.below[std::size_t(k)].frames);
      EXPECT_LE(result.below[std::size_t(k - 1)].path, result.below[std::size_t(k)].path);
    }
    EXPECT_DOUBLE_EQ(result.below[3].frames, result.coverage);
    EXPECT_DOUBLE_EQ(result.below[5].frames, result.coverage);
  }
}

TEST(SharesBelow, AreOfAKnownHalf) {
  // The second half is 1 m off: with a missing frame in the first, 49 of 100 are below.
  const Trajectory truth = circle(100);
  Trajectory estimate = truth;
  for (std::size_t i = 50; i < 100; ++i) estimate.poses[i].T_world_body->translation().y() += 1;
  estimate.poses[20].T_world_body.reset();
  EvaluationOptions options = unaligned();
  options.below = parse_error_bounds("0.5m,0.02rad");
  const EvaluationResult result = evaluate(truth, estimate, options);
  EXPECT_DOUBLE_EQ(result.below[0].frames, 0.49);
  EXPECT_NEAR(result.below[0].path, 47.0 / 99, 1e-12);
  EXPECT_DOUBLE_EQ(result.below[1].frames, 0.99);
  const std::vector<Metric> figures = metrics(result);
  const auto share = std::ranges::find(figures, "below_0.5m_frames", &Metric::key);
  ASSERT_NE(share, figures.end());
  EXPECT_EQ(share->value, 0.49);
  EXPECT_EQ(parse_error_bounds(to_string(options.below)), options.below);
}

TEST(SharesBelow, OfOrientationsNeedThem) {
  Trajectory truth = circle(100);
  truth.has_orientation = false;
  EvaluationOptions options;
  options.below = parse_error_bounds("0.5m,1deg");
  const EvaluationResult result = evaluate(truth, truth, options);
  EXPECT_TRUE(result.below[0].outcome);
  EXPECT_FALSE(result.below[1].outcome);
  for (const char* wrong : {"1s", "10f", "5", "0m", "-1deg", "m", "1m,,2m"})
    EXPECT_THROW((void)parse_error_bounds(wrong), ArgumentError) << wrong;
}

TEST(ScaleDrift, IsTheSlopeOfTheScale) {
  // An estimate whose steps grow by 1 % every 100 m.
  const Trajectory truth = test::winding_drive(1000);
  Trajectory estimate = truth;
  double travelled_m = 0;
  for (std::size_t i = 1; i < truth.size(); ++i) {
    const Eigen::Vector3d step = truth.poses[i].T_world_body->translation() -
                                 truth.poses[i - 1].T_world_body->translation();
    travelled_m += step.norm();
    estimate.poses[i].T_world_body->translation() =
        estimate.poses[i - 1].T_world_body->translation() + std::exp(1e-4 * travelled_m) * step;
  }
  const EvaluationResult result = evaluate(truth, estimate, unaligned());
  ASSERT_TRUE(result.profile.scale.outcome);
  EXPECT_NEAR(result.profile.scale.percent_per_100m, 1, 0.02);
  EXPECT_NEAR(result.profile.scale.largest / result.profile.scale.smallest,
              std::exp(1e-4 * travelled_m * 0.95), 0.005);
  EXPECT_NEAR(evaluate(truth, truth).profile.scale.percent_per_100m, 0, 1e-9);
}

}  // namespace error_profile_test
}  // namespace placegraph
