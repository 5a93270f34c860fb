#include <gtest/gtest.h>
#include <placegraph/frontend/places/loop_verifier.h>

#include "tests/support/scene.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace {

using namespace test;
using Code = Outcome::Code;
const Camera kCamera = pinhole(640, 480, 500);
const SE3 kTruth = pose({0.03, -0.1, 0.05}, {0.5, 0.1, 0.4});  // T_match_query

struct Visit {
  std::vector<Feature> query, match;
};

/// Two views of one scene, features in the same order; depths of both views exact.
Visit revisit(Random& random, int count = 120, double noise_px = 0.7) {
  PointScene scene = make_scene(kCamera, {SE3(), kTruth}, count, random);
  for (auto& px : scene.px) add_noise(px, noise_px, random);
  Visit visit;
  for (std::size_t i = 0; i < scene.points_ref.size(); ++i) {
    Feature match, query;
    match.px = scene.px[0][i].cast<float>();
    query.px = scene.px[1][i].cast<float>();
    match.descriptor = random_descriptor(random);
    query.descriptor = flipped(match.descriptor, 20, random);
    match.point_cam = scene.points_ref[i].cast<float>();
    query.point_cam = (kTruth.inverse() * scene.points_ref[i]).cast<float>();
    visit.match.push_back(match);
    visit.query.push_back(query);
  }
  return visit;
}

TEST(LoopVerifier, AcceptsARevisitWithItsPose) {
  Random random = seeded_random(91);
  Visit visit = revisit(random);
  // A third of the query shows other things, a third of the match has no depth.
  for (std::size_t i = 0; i < visit.query.size(); i += 3)
    visit.query[i].descriptor = random_descriptor(random);
  for (std::size_t i = 1; i < visit.match.size(); i += 3) visit.match[i].point_cam.reset();
  const auto result = verify_loop(kCamera, visit.query, visit.match, {}, random);
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  EXPECT_NEAR(result.inliers, 40, 2);
  EXPECT_GE(result.matches, result.inliers);
  const Vector6d error = (kTruth.inverse() * result.T_match_query).log();
  EXPECT_LT(error.dot(result.information.topLeftCorner<6, 6>() * error),
            2 * 22.5);  // the points carry noise too
  EXPECT_LT(distance_m(result.T_match_query, kTruth), 0.05);
  EXPECT_LT(angle_rad(result.T_match_query, kTruth), 0.5 * M_PI / 180);
}

TEST(LoopVerifier, RefusesAnotherPlace) {
  Random random = seeded_random(92);
  const Visit here = revisit(random), there = revisit(random);
  EXPECT_EQ(verify_loop(kCamera, here.query, there.match, {}, random).outcome.code,
            Code::kTooFewData);
  // Things that look alike but stand elsewhere.
  Visit alike = here;
  for (std::size_t i = 0; i < alike.query.size(); ++i)
    alike.query[i].px = there.query[(7 * i + 3) % there.query.size()].px;
  EXPECT_EQ(verify_loop(kCamera, alike.query, alike.match, {}, random).outcome.code,
            Code::kNoConsensus);
}

TEST(LoopVerifier, RefusesTheSameThingsInAnotherSize) {
  Random random = seeded_random(93);
  Visit visit = revisit(random);
  for (Feature& f : visit.query) *f.point_cam *= 1.4f;
  const auto result = verify_loop(kCamera, visit.query, visit.match, {}, random);
  EXPECT_EQ(result.outcome.code, Code::kInconsistent) << result.outcome.reason;
  EXPECT_GT(result.inliers, 100);
}

TEST(LoopVerifier, TellsTheRatioOfUnitsWhereItIsFree) {
  Random random = seeded_random(95);
  Visit visit = revisit(random);
  for (Feature& f : visit.query) *f.point_cam /= 3.0f;  // its unit is 3 m
  const auto result = verify_loop(kCamera, visit.query, visit.match, {}, random, true);
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  const Sim3 truth(kTruth.rotation(), kTruth.translation(), 3);
  const Sim3 found(result.T_match_query.rotation(), result.T_match_query.translation(),
                   result.scale_match_query);
  const Vector7d error = (truth.inverse() * found).log();
  EXPECT_NEAR(result.scale_match_query, 3, 0.05);
  EXPECT_LT(error.dot(result.information * error), 2 * 24.3);
  // Without depths of the query's own nothing tells.
  for (Feature& f : visit.query) f.point_cam.reset();
  const auto blind = verify_loop(kCamera, visit.query, visit.match, {}, random, true);
  EXPECT_EQ(blind.outcome.code, Code::kTooFewData) << blind.outcome.reason;
}

TEST(LoopVerifier, RefusesInliersCrowdedInOneCorner) {
  Random random = seeded_random(94);
  Visit visit = revisit(random, 4000, 0.3);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < visit.query.size(); ++i) {
    const Eigen::Vector2f d = visit.query[i].px - Eigen::Vector2f(320, 240);
    if (std::abs(d.x()) > 35 || std::abs(d.y()) > 35) continue;
    visit.query[kept] = visit.query[i];
    visit.match[kept++] = visit.match[i];
  }
  visit.query.resize(kept);
  visit.match.resize(kept);
  ASSERT_GT(static_cast<int>(kept), LoopVerifierOptions().pose.ransac.min_inliers);
  const auto result = verify_loop(kCamera, visit.query, visit.match, {}, random);
  EXPECT_EQ(result.outcome.code, Code::kDegenerate) << result.outcome.reason;
}

TEST(LoopVerifier, RefusesASmallShareOfInliers) {
  Random random = seeded_random(95);
  Visit visit = revisit(random, 200);
  // Near each remaining projection stands another thing that looks like it.
  LoopVerifierOptions options;
  options.min_inlier_ratio = 0.9;
  for (std::size_t i = 0; i < visit.query.size(); i += 3)
    visit.query[i].px += Eigen::Vector2f(6, 0);
  const auto result = verify_loop(kCamera, visit.query, visit.match, options, random);
  EXPECT_EQ(result.outcome.code, Code::kNoConsensus) << result.outcome.reason;
  EXPECT_LT(result.inliers, 0.9 * result.matches);
}

TEST(LoopVerifier, RefusesAMatchWithoutDepth) {
  Random random = seeded_random(96);
  Visit visit = revisit(random);
  for (Feature& f : visit.match) f.point_cam.reset();
  const auto result = verify_loop(kCamera, visit.query, visit.match, {}, random);
  EXPECT_EQ(result.outcome.code, Code::kTooFewData);
  EXPECT_EQ(result.matches, 0);
}

}  // namespace
}  // namespace placegraph
