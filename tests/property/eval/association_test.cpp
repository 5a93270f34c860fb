#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/eval/trajectory/common_frames.h>

#include "tests/support/trajectories.h"

namespace placegraph {
namespace association_property_test {

using ::testing::HasSubstr;

/// The winding drive seen at a rate [Hz], with stamps off by a constant and jitter [s].
Trajectory seen_at(double rate_hz, double seconds, double offset_s, double jitter_s,
                   Random& random) {
  const Trajectory dense = test::winding_drive(static_cast<int>(seconds * 10) + 2);
  Trajectory seen;
  std::int64_t last_ns = -1;
  for (int i = 0; i < static_cast<int>(seconds * rate_hz); ++i) {
    const double time_s = i / rate_hz;
    const auto pose = interpolate(dense, std::llround(time_s * 1e9));
    if (!pose) continue;
    std::int64_t stamp_ns =
        std::llround((time_s + offset_s + random.uniform(-jitter_s, jitter_s) + 1000) * 1e9);
    stamp_ns = std::max(stamp_ns, last_ns + 1);
    seen.poses.push_back({last_ns = stamp_ns, pose->isometry()});
  }
  return seen;
}

TEST(Association, OfClocksThatAreOffIsRefusedWithTheConstantThatPairsThem) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const double rate_hz = random.uniform(8, 20);
    // Beyond the largest difference, and less than half a spacing beyond the next pose.
    const double offset_s = (seed % 2 ? 1 : -1) * random.uniform(0.0245, 0.45 / rate_hz + 0.002);
    const Trajectory truth = seen_at(rate_hz, 30, 0, 0, random);
    const Trajectory estimate = seen_at(rate_hz, 30, offset_s, 0.002, random);
    const EvaluationResult refused = evaluate(truth, estimate);
    ASSERT_EQ(refused.outcome.code, Outcome::Code::kInconsistent)
        << rate_hz << " Hz, " << offset_s << " s: posed " << refused.posed;
    EXPECT_THAT(refused.outcome.reason, HasSubstr("--offset"));
    const std::string& reason = refused.outcome.reason;
    EvaluationOptions options;
    options.time.offset_s = std::stod(reason.substr(reason.find("--offset ") + 9));
    EXPECT_NEAR(options.time.offset_s, -offset_s, 0.01);
    const EvaluationResult paired = evaluate(truth, estimate, options);
    EXPECT_TRUE(paired.outcome);
    EXPECT_GT(paired.coverage, 0.95);
  }
}

TEST(Association, OfRatesThatDifferIsNotRefused) {
  Random random(5);
  for (const double truth_hz : {5.0, 10.0, 30.0, 100.0, 200.0})
    for (const double estimate_hz : {7.0, 10.0, 20.0, 200.0}) {
      SCOPED_TRACE(std::to_string(truth_hz) + " and " + std::to_string(estimate_hz));
      // The sparser of both finds partners if the denser one has a pose every 40 ms.
      if (std::max(truth_hz, estimate_hz) < 25 && truth_hz != estimate_hz) continue;
      const EvaluationResult result = evaluate(seen_at(truth_hz, 20, 0, 0.001, random),
                                               seen_at(estimate_hz, 20, 0, 0.001, random));
      EXPECT_TRUE(result.outcome) << result.outcome.reason;
      EXPECT_GT(result.coverage, 0.9);
    }
}

TEST(Association, UsesEachTrueposeOnceAndSaysWhatItDoesNotUse) {
  Random random(3);
  const Trajectory truth = seen_at(100, 10, 0, 0, random), estimate = seen_at(200, 10, 0, 0, random);
  const EvaluationResult result = evaluate(truth, estimate);
  ASSERT_TRUE(result.outcome);
  EXPECT_EQ(result.posed, result.frames);
  EXPECT_NEAR(result.rpe.translation_m.max, 0, 1e-9);
  EXPECT_EQ(result.estimate_beside_nearer, result.estimate_without_truth);
  EXPECT_THAT(result.warnings, ::testing::Contains(HasSubstr("that a nearer pose uses")));
  EXPECT_THAT(result.warnings,
              ::testing::Not(::testing::Contains(HasSubstr("have no ground truth"))));
}

TEST(Association, CountsWhatTheTruthCovers) {
  Random random(4);
  const Trajectory truth = seen_at(10, 30, 0, 0, random);
  Trajectory late = truth;
  late.poses.erase(late.poses.begin(), late.poses.begin() + 100);
  EXPECT_NEAR(evaluate(truth, late).coverage, 2.0 / 3, 0.01);
  // A truth with a hole covers less, and says so.
  Trajectory holed = truth;
  holed.poses.erase(holed.poses.begin() + 100, holed.poses.begin() + 200);
  const EvaluationResult result = evaluate(holed, truth);
  EXPECT_DOUBLE_EQ(result.coverage, 1);
  EXPECT_THAT(result.warnings, ::testing::Contains(HasSubstr("the ground truth has a hole of 10")));
}

/// The trajectory without a share of its poses, those first in an order.
Trajectory without_share(const Trajectory& trajectory, const std::vector<std::size_t>& order,
                         double share) {
  std::vector<bool> lost(trajectory.size(), false);
  const auto count = static_cast<std::size_t>(share * static_cast<double>(order.size()));
  for (std::size_t i = 0; i < count; ++i) lost[order[i]] = true;
  Trajectory rest = trajectory;
  rest.poses.clear();
  for (std::size_t i = 0; i < trajectory.size(); ++i)
    if (!lost[i]) rest.poses.push_back(trajectory.poses[i]);
  return rest;
}

std::vector<std::size_t> random_order(std::size_t size, Random& random) {
  std::vector<std::size_t> order(size);
  for (std::size_t i = 0; i < size; ++i) {
    const auto other = std::min(i, static_cast<std::size_t>(random.uniform(0, double(i + 1))));
    order[i] = order[other];
    order[other] = i;
  }
  return order;
}

TEST(Association, CoverageNeverRisesAsMorePosesAreLostAtRandom) {
  for (const double estimate_hz : {10.0, 20.0})
    for (const double denser : {1.0, 2.0, 10.0})
      for (const double jitter : {0.0, 0.05, 1.0 / 6})  // of a spacing: a third between two stamps
        for (std::uint64_t seed = 1; seed <= 4; ++seed) {
          SCOPED_TRACE(fmt::format("{} Hz, truth {} times as dense, jitter {}, seed {}", estimate_hz,
                                   denser, jitter, seed));
          Random random(seed);
          const Trajectory truth = seen_at(denser * estimate_hz, 40, 0, 0, random);
          const Trajectory whole = seen_at(estimate_hz, 40, 0, jitter / estimate_hz, random);
          const std::vector<std::size_t> order = random_order(whole.size(), random);
          double last = 1;
          for (const double share : {0.0, 0.2, 0.4, 0.45, 0.5, 0.55, 0.6, 0.65, 0.7, 0.8, 0.85}) {
            const PairingResult paired = pair_trajectories(
                truth, without_share(whole, order, share), Association::kTime, {0.02, 0});
            ASSERT_TRUE(paired.outcome) << share << ": " << paired.outcome.reason;
            const double coverage = double(paired.posed) / double(paired.pairs.size());
            EXPECT_LE(coverage, last) << share << " lost";
            // Of a hole of few poses the ends, off by jitter, decide whether one more is missing.
            EXPECT_NEAR(coverage, 1 - share, jitter > 0 ? 0.06 : 0.01);
            last = coverage;
          }
        }
}

CommonResult common_of(const Trajectory& truth, const std::vector<Trajectory>& estimates) {
  std::vector<PairingResult> paired;
  std::vector<std::string> names;
  for (const Trajectory& estimate : estimates) {
    paired.push_back(pair_trajectories(truth, estimate, Association::kAuto, {}));
    names.push_back("e" + std::to_string(names.size()));
  }
  return on_common_frames(paired, names, {});
}

TEST(CommonFrames, MakeOneDriveOfTheSameEstimateWhoeverCoversLess) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Random random(seed);
    const Trajectory truth = test::winding_drive(150 + 10 * int(seed));
    const Trajectory whole = test::drifting(truth, 0.02, 0.002, random);
    Trajectory part = whole;
    const auto first = std::ptrdiff_t(random.uniform(0, 60)),
               last = first + std::ptrdiff_t(random.uniform(40, 90));
    part.poses.erase(part.poses.begin() + last, part.poses.end());
    part.poses.erase(part.poses.begin(), part.poses.begin() + first);
    const CommonResult common = common_of(truth, {whole, part});
    ASSERT_TRUE(common.needed);
    ASSERT_EQ(common.results.size(), 2u);
    EXPECT_EQ(common.results[0].posed, last - first);
    EXPECT_NEAR(common.results[0].ape.error_m.rmse, common.results[1].ape.error_m.rmse, 1e-12);
    EXPECT_NEAR(common.results[0].rpe.translation_m.rmse,
                common.results[1].rpe.translation_m.rmse, 1e-12);
    EXPECT_NEAR(common.results[1].ape.error_m.rmse, evaluate(truth, part).ape.error_m.rmse, 1e-12);
  }
}

TEST(CommonFrames, AreNotNeededWhereAllCoverTheSameAtTheirOwnRates) {
  Random random(2);
  const Trajectory truth = seen_at(100, 20, 0, 0, random);
  const Trajectory slow = seen_at(7, 20, 0, 0.001, random), fast = seen_at(50, 20, 0, 0, random);
  EXPECT_FALSE(common_of(truth, {slow, fast}).needed);
  EXPECT_FALSE(common_of(truth, {slow}).needed);
  Trajectory lost = fast;  // from 8 to 12 s
  lost.poses.erase(lost.poses.begin() + 400, lost.poses.begin() + 600);
  const CommonResult common = common_of(truth, {slow, lost});
  ASSERT_TRUE(common.needed);
  for (const EvaluationResult& result : common.results)
    for (const FramePair& pair : result.aligned_pairs) {
      const double seconds = static_cast<double>(pair.stamp_ns) * 1e-9 - 1000;
      EXPECT_FALSE(pair.T_world_estimate && seconds > 8.1 && seconds < 11.9) << seconds;
    }
}

TEST(CommonFrames, OfEstimatesThatNeverMeetGiveNoFigures) {
  const Trajectory truth = test::winding_drive(100);
  Trajectory first = truth, second = truth;
  first.poses.resize(40);
  second.poses.erase(second.poses.begin(), second.poses.begin() + 60);
  const CommonResult common = common_of(truth, {first, second});
  ASSERT_TRUE(common.needed);
  for (const EvaluationResult& result : common.results) EXPECT_FALSE(result.outcome);
}

}  // namespace association_property_test
}  // namespace placegraph
