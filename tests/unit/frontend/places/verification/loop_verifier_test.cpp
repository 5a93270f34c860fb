#include <gtest/gtest.h>
#include <placegraph/frontend/places/verification/loop_verifier.h>
#include <placegraph/graph/core/angle.h>

#include "tests/support/scenes/scene.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace loop_verifier_test {

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
  EXPECT_LT(angle_rad(result.T_match_query, kTruth), deg_to_rad(0.5));
}

TEST(LoopVerifier, RefusesAnotherPlace) {
  Random random = seeded_random(92);
  const Visit here = revisit(random), there = revisit(random);
  EXPECT_EQ(verify_loop(kCamera, here.query, there.match, {}, random).outcome.code,
            Code::kTooFewData);
  // Things that look alike but stand elsewhere.
  Visit similar = here;
  for (std::size_t i = 0; i < similar.query.size(); ++i)
    similar.query[i].px = there.query[(7 * i + 3) % there.query.size()].px;
  EXPECT_EQ(verify_loop(kCamera, similar.query, similar.match, {}, random).outcome.code,
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

TEST(LoopVerifier, RefusesViewsWithoutDepth) {
  Random random = seeded_random(96);
  Visit visit = revisit(random);
  for (Feature& f : visit.match) f.point_cam.reset();
  // The query's own depths are as good.
  const auto by_query = verify_loop(kCamera, visit.query, visit.match, {}, random);
  ASSERT_TRUE(by_query.outcome) << by_query.outcome.reason;
  EXPECT_LT(distance_m(by_query.T_match_query, kTruth), 0.1);
  for (Feature& f : visit.query) f.point_cam.reset();
  const auto result = verify_loop(kCamera, visit.query, visit.match, {}, random);
  EXPECT_EQ(result.outcome.code, Code::kTooFewData);
  EXPECT_EQ(result.matches, 0);
}

/// Depths stay with the first `known` matches alone.
void forget_depths(Visit& visit, std::size_t known) {
  for (std::size_t i = known; i < visit.match.size(); ++i) {
    visit.match[i].point_cam.reset();
    visit.query[i].point_cam.reset();
  }
}

TEST(LoopVerifier, FewDepthsGiveTheLengthOfAnEssentialMatrix) {
  Random random = seeded_random(101);
  Visit visit = revisit(random, 160, 0.3);
  forget_depths(visit, 15);
  const auto result = verify_loop(kCamera, visit.query, visit.match, {}, random);
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  EXPECT_EQ(result.model, LoopModel::kEssential);
  EXPECT_GT(result.inliers, 140);
  EXPECT_LT(distance_m(result.T_match_query, kTruth), 0.05);
  EXPECT_LT(angle_rad(result.T_match_query, kTruth), deg_to_rad(0.3));
  const Vector6d error = (kTruth.inverse() * result.T_match_query).log();
  EXPECT_LT(error.dot(result.information.topLeftCorner<6, 6>() * error), 2 * 22.5);
  // All depths known: by them.
  const Visit known = revisit(random);
  EXPECT_EQ(verify_loop(kCamera, known.query, known.match, {}, random).model,
            LoopModel::kPoints3d2d);
}

TEST(LoopVerifier, WithoutAnyDepthAnEssentialMatrixHasNoLength) {
  Random random = seeded_random(102);
  Visit visit = revisit(random, 160, 0.3);
  forget_depths(visit, 4);
  const auto result = verify_loop(kCamera, visit.query, visit.match, {}, random);
  EXPECT_EQ(result.outcome.code, Code::kTooFewData) << result.outcome.reason;
}

TEST(LoopVerifier, RefusesALengthThatDepthsDisagreeOn) {
  Random random = seeded_random(103);
  Visit visit = revisit(random, 160, 0.3);
  forget_depths(visit, 20);
  for (std::size_t i = 0; i < 20; ++i) {
    const float wrong = static_cast<float>(std::exp(random.uniform(-2, 2)));
    *visit.match[i].point_cam *= wrong;
    visit.query[i].point_cam.reset();
  }
  EXPECT_FALSE(verify_loop(kCamera, visit.query, visit.match, {}, random).outcome);
}

/// Two views of one scene from T_match_query, the first `known` with depth.
Visit visit_of(const PointScene& scene, std::size_t known, Random& random) {
  Visit visit;
  for (std::size_t i = 0; i < scene.points_ref.size(); ++i) {
    Feature match, query;
    match.px = scene.px[0][i].cast<float>();
    query.px = scene.px[1][i].cast<float>();
    match.descriptor = random_descriptor(random);
    query.descriptor = flipped(match.descriptor, 20, random);
    if (i < known) match.point_cam = scene.points_ref[i].cast<float>();
    visit.match.push_back(match);
    visit.query.push_back(query);
  }
  return visit;
}

TEST(LoopVerifier, APlaneIsPlacedByItsHomography) {
  Random random = seeded_random(104);
  // A wall, seen at a slant: z = 6 + 0.5 x.
  PointScene scene = make_scene(kCamera, {SE3(), kTruth}, 160, random,
                                [](const Eigen::Vector3d& ray) { return 6 / (1 - 0.5 * ray.x()); });
  for (auto& px : scene.px) add_noise(px, 0.2, random);
  const Visit visit = visit_of(scene, 20, random);
  const auto result = verify_loop(kCamera, visit.query, visit.match, {}, random);
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  EXPECT_EQ(result.model, LoopModel::kHomography);
  EXPECT_LT(distance_m(result.T_match_query, kTruth), 0.08);
  EXPECT_LT(angle_rad(result.T_match_query, kTruth), deg_to_rad(0.6));
}

TEST(LoopVerifier, APureRotationHasNoTranslationThatFewDepthsCouldMeasure) {
  Random random = seeded_random(105);
  PointScene scene = make_scene(kCamera, {SE3(), pose({0.03, -0.1, 0.05}, {0, 0, 0})}, 160, random);
  for (auto& px : scene.px) add_noise(px, 0.3, random);
  const Visit visit = visit_of(scene, 15, random);
  // Fifteen points of known depth are too few by themselves, and a turn is no baseline.
  EXPECT_FALSE(verify_loop(kCamera, visit.query, visit.match, {}, random).outcome);
}

/// Edges of the scene in both views, with the match's lines.
struct Edges {
  std::vector<LineFeature> query, match;
};
Edges edges(int count, Random& random) {
  Edges result;
  while (static_cast<int>(result.match.size()) < count) {
    const Eigen::Vector3d start(random.uniform(-4, 4), random.uniform(-3, 3),
                                random.uniform(5, 12));
    const Eigen::Vector3d end =
        start +
        Eigen::Vector3d(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-1, 1));
    const SE3 T_query_match = kTruth.inverse();
    const auto p = kCamera.project(start), q = kCamera.project(end),
               r = kCamera.project(T_query_match * start), s = kCamera.project(T_query_match * end);
    if (!p || !q || !r || !s || !kCamera.contains(*p) || !kCamera.contains(*q) ||
        !kCamera.contains(*r) || !kCamera.contains(*s) || (*p - *q).norm() < 25 ||
        (*r - *s).norm() < 25)
      continue;
    const BinaryDescriptor descriptor = random_descriptor(random);
    result.match.push_back({{*p, *q}, descriptor, Line3::from_direction(start, end - start)});
    result.query.push_back({{*r, *s}, flipped(descriptor, 20, random), std::nullopt});
  }
  return result;
}

TEST(LoopVerifier, LinesBringWhatPointsLack) {
  Random random = seeded_random(106);
  const Visit visit = revisit(random, 28);  // fewer than the forty it takes
  EXPECT_FALSE(verify_loop(kCamera, visit.query, visit.match, {}, random).outcome);
  const Edges lines = edges(20, random);
  const auto result =
      verify_loop(kCamera, {visit.query, lines.query}, {visit.match, lines.match}, {}, random);
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  EXPECT_GE(result.lines, 17);
  EXPECT_LT(distance_m(result.T_match_query, kTruth), 0.05);
  // Lines of elsewhere bring nothing.
  const Edges others = edges(20, random);
  EXPECT_FALSE(
      verify_loop(kCamera, {visit.query, others.query}, {visit.match, lines.match}, {}, random)
          .outcome);
}

TEST(LoopVerifier, LinesMakeAPoseSurer) {
  Random random = seeded_random(107);
  const Visit visit = revisit(random, 60);
  const Edges lines = edges(30, random);
  Random one = seeded_random(108), same = seeded_random(108);
  const auto points = verify_loop(kCamera, visit.query, visit.match, {}, one);
  const auto both =
      verify_loop(kCamera, {visit.query, lines.query}, {visit.match, lines.match}, {}, same);
  ASSERT_TRUE(points.outcome && both.outcome);
  EXPECT_GT((both.information.topLeftCorner<6, 6>() * both.rmse_px * both.rmse_px).trace(),
            (points.information.topLeftCorner<6, 6>() * points.rmse_px * points.rmse_px).trace());
}

}  // namespace loop_verifier_test
}  // namespace placegraph
