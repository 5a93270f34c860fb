#include <gtest/gtest.h>
#include <placegraph/eval/errors/relative_error.h>
#include <placegraph/graph/core/angle.h>

#include "tests/support/trajectories.h"

namespace placegraph {
namespace relative_error_property_test {

using test::isometry;

/// A drive with drift, lost frames and holes in its times.
std::vector<FramePair> broken_drive(Random& random, int frames) {
  const Trajectory truth = test::winding_drive(frames, random.uniform(0.05, 2));
  const Trajectory estimate = test::drifting(truth, 0.01, 0.002, random);
  std::vector<FramePair> pairs;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (i > 0 && random.uniform(0, 1) < 0.01) i += std::size_t(random.uniform(2, 20));
    if (i >= truth.size()) break;
    FramePair pair;
    pair.frame = static_cast<int>(i);
    pair.stamp_ns = truth.poses[i].stamp_ns;
    pair.T_world_truth = *truth.poses[i].T_world_body;
    if (random.uniform(0, 1) > 0.02) pair.T_world_estimate = estimate.poses[i].T_world_body;
    pairs.push_back(pair);
  }
  return pairs;
}

/// The measure of a step by the definition, summed anew for each.
double measure(const std::vector<FramePair>& pairs, int first, int last, Delta::Unit unit) {
  double sum = 0;
  for (int i = first + 1; i <= last; ++i) {
    const FramePair &a = pairs[std::size_t(i - 1)], &b = pairs[std::size_t(i)];
    if (unit == Delta::Unit::kFrames) sum += 1;
    if (unit == Delta::Unit::kSeconds) sum += static_cast<double>(b.stamp_ns - a.stamp_ns) * 1e-9;
    if (unit == Delta::Unit::kMetres)
      sum += (b.T_world_truth.translation() - a.T_world_truth.translation()).norm();
    if (unit == Delta::Unit::kDegrees)
      sum += rad_to_deg(Eigen::AngleAxisd(a.T_world_truth.linear().transpose() *
                                          b.T_world_truth.linear())
                            .angle());
  }
  return sum;
}

bool whole(const std::vector<FramePair>& pairs, int first, int last) {
  for (int i = first; i <= last; ++i) {
    const FramePair& pair = pairs[std::size_t(i)];
    if (!pair.T_world_estimate) return false;
    if (i > first && pair.stamp_ns - pairs[std::size_t(i - 1)].stamp_ns > 150'000'000) return false;
  }
  return true;
}

TEST(RelativeErrors, AreThoseOfEveryStepThatTheDefinitionAllows) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const std::vector<FramePair> pairs = broken_drive(random, 60 + 20 * int(seed));
    const int n = static_cast<int>(pairs.size());
    for (const Delta delta : {Delta{3, Delta::Unit::kFrames}, Delta{0.7, Delta::Unit::kSeconds},
                              Delta{random.uniform(0.5, 5), Delta::Unit::kMetres},
                              Delta{random.uniform(1, 10), Delta::Unit::kDegrees}}) {
      SCOPED_TRACE(to_string(delta));
      std::vector<std::pair<int, int>> expected, found;
      for (int i = 0; i < n; ++i)
        for (int j = i + 1; j < n && whole(pairs, i, j); ++j) {
          const double length = measure(pairs, i, j, delta.unit);
          // The nearest of poses a tenth of a second apart, or the first at or beyond.
          const double reach = delta.unit == Delta::Unit::kSeconds ? 0.05 : 1e-9 * delta.value;
          if (length < delta.value - reach) continue;
          expected.emplace_back(i, j);
          break;
        }
      const RelativeErrors all = relative_errors(pairs, true, delta, StepPairs::kAll);
      for (const RelativeError& step : all.errors) found.emplace_back(step.first, step.last);
      EXPECT_EQ(found, expected);
      // Consecutive steps are those of all steps that begin where the one before ends, or behind
      // a gap.
      const RelativeErrors chain = relative_errors(pairs, true, delta);
      for (std::size_t k = 0; k < chain.errors.size(); ++k) {
        const std::pair step(chain.errors[k].first, chain.errors[k].last);
        EXPECT_NE(std::find(expected.begin(), expected.end(), step), expected.end());
        if (k > 0 && chain.errors[k - 1].last != step.first) {
          EXPECT_FALSE(whole(pairs, chain.errors[k - 1].last, step.first));
        }
      }
    }
  }
}

TEST(RelativeErrors, DoNotDependOnTheFrameNorOnTheAlignment) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Random random(seed);
    std::vector<FramePair> pairs = broken_drive(random, 120);
    const Delta delta{2, Delta::Unit::kMetres};
    const Eigen::Vector3d up = Eigen::Vector3d(0.1, -1, 0.2).normalized();
    const RelativeErrors before = relative_errors(pairs, true, delta, StepPairs::kAll, 1, up);
    const Eigen::Isometry3d A = isometry({0.3, -2, 1}, {100, -50, 7});
    const Eigen::Isometry3d B = isometry({-1, 0.2, 2}, {-9, 3, 800});
    for (FramePair& pair : pairs) {
      pair.T_world_truth = A * pair.T_world_truth;
      if (pair.T_world_estimate) pair.T_world_estimate = B * *pair.T_world_estimate;
    }
    // The vertical is that of the truth's world, and turns with it.
    const RelativeErrors after =
        relative_errors(pairs, true, delta, StepPairs::kAll, 1, A.linear() * up);
    ASSERT_EQ(before.errors.size(), after.errors.size());
    EXPECT_NEAR(before.translation_m.rmse, after.translation_m.rmse, 1e-10);
    EXPECT_NEAR(before.rotation_deg.rmse, after.rotation_deg.rmse, 1e-10);
    EXPECT_NEAR(before.heading_deg.rmse, after.heading_deg.rmse, 1e-10);
    EXPECT_NEAR(before.inclination_deg.rmse, after.inclination_deg.rmse, 1e-10);
    for (const RelativeError& step : before.errors)  // both parts are of the whole
      EXPECT_LE(std::max(step.heading_deg, step.inclination_deg), step.rotation_deg + 1e-9);
    EXPECT_NEAR(before.full.rmse, after.full.rmse, 1e-10);
  }
}

}  // namespace relative_error_property_test
}  // namespace placegraph
