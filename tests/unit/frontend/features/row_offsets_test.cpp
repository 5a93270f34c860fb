#include <gtest/gtest.h>
#include <placegraph/frontend/features/row_offsets.h>

namespace placegraph {
namespace row_offsets_test {

/// Samples all over the image whose rows are off by `rows(ray)` and noise; a share of them is
/// wrong.
template <class Rows>
std::vector<RowSample> samples(const Rows& rows, int count = 400, double wrong = 0.2,
                               double disparity_px = 8) {
  Random random(3, 0);
  std::vector<RowSample> result;
  for (int i = 0; i < count; ++i) {
    RowSample s;
    s.ray = {random.uniform(-0.8, 0.8), random.uniform(-0.3, 0.3)};
    s.rows = rows(s.ray) + 0.5 * random.normal();
    if (random.uniform(0, 1) < wrong) s.rows = random.uniform(-15, 15);
    s.disparity_px = disparity_px;
    result.push_back(s);
  }
  return result;
}

RowOffsets fit(const std::vector<RowSample>& samples) {
  Random random(1, 0);
  return fit_row_offsets(samples, random);
}

TEST(RowOffsets, OfARectifiedPairAreNone) {
  const RowOffsets found = fit(samples([](const auto&) { return 0.0; }));
  ASSERT_TRUE(found.outcome) << found.outcome.reason;
  EXPECT_LT(found.rms_px, 0.1);
  EXPECT_EQ(found.matches, 400);
  EXPECT_GT(found.inliers, 300);
  EXPECT_EQ(found.behind, 0);
}

TEST(RowOffsets, AreFoundForShiftRollZoomAndPitch) {
  const auto shift = fit(samples([](const auto&) { return 4.0; }));
  ASSERT_TRUE(shift.outcome);
  EXPECT_NEAR(shift.rows[0], 4, 0.15);
  const auto roll = fit(samples([](const auto& ray) { return 12 * ray.x(); }));
  ASSERT_TRUE(roll.outcome);
  EXPECT_NEAR(roll.rows[1], 12, 0.3);
  const auto zoom = fit(samples([](const auto& ray) { return 7 * ray.y(); }));
  ASSERT_TRUE(zoom.outcome);
  EXPECT_NEAR(zoom.rows[2], 7, 0.7);
  const auto pitch =
      fit(samples([](const auto& ray) { return 6 * (1 + ray.y() * ray.y()) + 2 * ray.x(); }));
  ASSERT_TRUE(pitch.outcome);
  EXPECT_NEAR(pitch.at({0.5, 0.2}), 6 * 1.04 + 1, 0.3);
  EXPECT_NEAR(pitch.rms_px, 6.3, 0.3);
}

TEST(RowOffsets, CountMatchesOnTheWrongSide) {
  const RowOffsets found = fit(samples([](const auto&) { return 0.0; }, 400, 0.1, -8));
  EXPECT_EQ(found.behind, found.inliers);
}

TEST(RowOffsets, AreUnknownFromFewOrContradictingMatches) {
  EXPECT_EQ(fit(samples([](const auto&) { return 0.0; }, 20)).outcome.code,
            Outcome::Code::kTooFewData);
  const RowOffsets found = fit(samples([](const auto&) { return 0.0; }, 100, 1.0));
  EXPECT_TRUE(!found.outcome || found.inliers < 50);
}

}  // namespace row_offsets_test
}  // namespace placegraph
