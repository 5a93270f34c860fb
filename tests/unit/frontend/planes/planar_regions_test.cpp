#include <gtest/gtest.h>
#include <placegraph/frontend/planes/planar_regions.h>
#include <placegraph/graph/core/error.h>

#include <numeric>

#include "tests/support/scenes/planes_world.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace planar_regions_test {

using namespace test;

const SE3 kMotion = pose({0.02, -0.06, 0.03}, {0.9, -0.2, 0.4});

TEST(PlanarRegions, FindsOneOrTwoPlanesAmongOutliers) {
  Random random = seeded_random(71);
  for (int w = 0; w < 6; ++w) {
    const int planes = 1 + w % 2;
    const PlanesWorld world = make_planes_world(planes, 40, 40, 0.5, kMotion, random);
    const PlanarRegionsResult result = find_planar_regions(world.matches, {}, random);
    ASSERT_TRUE(result.outcome) << result.outcome.reason;
    EXPECT_EQ(result.regions.size(), static_cast<std::size_t>(planes));
    // A match may lie near the edge between two planes, an outlier by chance on one.
    EXPECT_LT(misclassification(world.labels, result.labels), 0.05) << planes << " planes";
    EXPECT_LT(result.description_length, 0);
  }
}

TEST(PlanarRegions, TakesPlanesForOneOnlyWhereOneHomographyExplainsThem) {
  // Every other wall of the zigzag is nearly parallel; where two are about as far, too (a third to
  // a half of such worlds), one homography has all their matches within the noise.
  Random random = seeded_random(74);
  for (const int planes : {3, 4, 3}) {
    const PlanesWorld world = make_planes_world(planes, 40, 40, 0.5, kMotion, random);
    const PlanarRegionsResult result = find_planar_regions(world.matches, {}, random);
    ASSERT_TRUE(result.outcome) << result.outcome.reason;
    EXPECT_GE(result.regions.size(), 2U);
    EXPECT_LE(result.regions.size(), static_cast<std::size_t>(planes));
    EXPECT_LT(result.noise.sigma_px, 0.65);
    const double missed = planes - static_cast<double>(result.regions.size());
    EXPECT_LT(misclassification(world.labels, result.labels), 0.05 + missed / (planes + 1));
  }
}

TEST(PlanarRegions, FindsAPlaneUnderFourFifthsOfOutliers) {
  Random random = seeded_random(72);
  const PlanesWorld world = make_planes_world(1, 40, 160, 0.5, kMotion, random);
  const PlanarRegionsResult result = find_planar_regions(world.matches, {}, random);
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  EXPECT_LT(misclassification(world.labels, result.labels), 0.04);
}

TEST(PlanarRegions, EstimatesTheNoise) {
  // Student t fitted to normal noise: its sigma is smaller, by a factor of about 0.75 for three
  // degrees of freedom.
  Random random = seeded_random(73);
  for (const double sigma_px : {0.3, 1.0}) {
    const PlanesWorld world = make_planes_world(2, 80, 30, sigma_px, kMotion, random);
    PlanarRegionsOptions options;
    options.noise_confidence = 1;
    const PlanarRegionsResult result = find_planar_regions(world.matches, options, random);
    ASSERT_TRUE(result.outcome);
    EXPECT_GT(result.noise.sigma_px, 0.55 * sigma_px);
    EXPECT_LT(result.noise.sigma_px, 1.1 * sigma_px);
  }
}

TEST(PlanarRegions, SeesNoPlaneInRandomMatches) {
  Random random = seeded_random(74);
  const PlanesWorld world = make_planes_world(0, 0, 150, 0, kMotion, random);
  const PlanarRegionsResult result = find_planar_regions(world.matches, {}, random);
  EXPECT_EQ(result.outcome.code, Outcome::Code::kNoConsensus);
  EXPECT_EQ(result.labels, std::vector<int>(150, 0));
  EXPECT_TRUE(result.regions.empty());
}

TEST(PlanarRegions, NeedsMatchesAndAsManyPixelsInBothViews) {
  Random random = seeded_random(75);
  PointMatches matches{{{0, 0}, {9, 0}}, {{0, 0}, {9, 0}}};
  EXPECT_EQ(find_planar_regions(matches, {}, random).outcome.code, Outcome::Code::kTooFewData);
  EXPECT_EQ(find_planar_regions({}, {}, random).outcome.code, Outcome::Code::kTooFewData);
  matches.px_cur.pop_back();
  EXPECT_THROW((void)find_planar_regions(matches, {}, random), ArgumentError);
}

TEST(PlanarRegions, SurvivesMatchesThatAreAllTheSameOrInALine) {
  Random random = seeded_random(76);
  PointMatches same, line;
  for (int i = 0; i < 30; ++i) {
    same.px_ref.emplace_back(5, 5);
    same.px_cur.emplace_back(7, 7);
    line.px_ref.emplace_back(10 * i, 20 * i);
    line.px_cur.emplace_back(10 * i + 3, 20 * i);
  }
  EXPECT_EQ(find_planar_regions(same, {}, random).outcome.code, Outcome::Code::kNoConsensus);
  EXPECT_EQ(find_planar_regions(line, {}, random).outcome.code, Outcome::Code::kNoConsensus);
}

TEST(PlanarRegions, AreTheSameWhateverTheOrderOfTheMatchesButForChance) {
  Random random = seeded_random(77);
  const PlanesWorld world = make_planes_world(3, 40, 30, 0.5, kMotion, random);
  const int n = world.matches.size();
  std::vector<int> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  for (int i = n - 1; i > 0; --i) std::swap(order[i], order[random.index(i + 1)]);
  PointMatches shuffled;
  for (const int i : order) {
    shuffled.px_ref.push_back(world.matches.px_ref[i]);
    shuffled.px_cur.push_back(world.matches.px_cur[i]);
  }
  const auto first = find_planar_regions(world.matches, {}, random);
  const auto second = find_planar_regions(shuffled, {}, random);
  std::vector<int> back(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) back[order[i]] = second.labels[i];
  EXPECT_LT(misclassification(first.labels, back), 0.02);
}

TEST(PlanarRegions, AreTheSameBitsForTheSameSeed) {
  Random random = seeded_random(78);
  const PlanesWorld world = make_planes_world(2, 30, 30, 0.5, kMotion, random);
  Random one(5), two(5);
  const auto first = find_planar_regions(world.matches, {}, one);
  const auto second = find_planar_regions(world.matches, {}, two);
  EXPECT_EQ(first.labels, second.labels);
  EXPECT_EQ(first.description_length, second.description_length);
}

}  // namespace planar_regions_test
}  // namespace placegraph
