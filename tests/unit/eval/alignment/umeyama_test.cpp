#include <gtest/gtest.h>
#include <placegraph/eval/alignment/alignment.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/geometry/so3.h>

#include "tests/support/trajectories.h"

namespace placegraph {
namespace umeyama_test {

using test::isometry;

const std::vector<Eigen::Vector3d> kCorners = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 5}};

std::vector<Eigen::Vector3d> transformed(const std::vector<Eigen::Vector3d>& points,
                                         const Eigen::Isometry3d& T, double scale) {
  std::vector<Eigen::Vector3d> out;
  for (const Eigen::Vector3d& p : points) out.push_back(scale * (T.linear() * p) + T.translation());
  return out;
}

FramePair pair_of(const Eigen::Isometry3d& T_world_truth,
                  const Eigen::Isometry3d& T_world_estimate) {
  FramePair pair;
  pair.T_world_truth = T_world_truth;
  pair.T_world_estimate = T_world_estimate;
  return pair;
}

TEST(Umeyama, RecoversASimilarityExactly) {
  const Eigen::Isometry3d T = isometry({0.3, -1.2, 2.0}, {4, -5, 6});
  const AlignmentResult result = umeyama(kCorners, transformed(kCorners, T, 2.5), true);
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  EXPECT_NEAR(result.scale, 2.5, 1e-12);
  EXPECT_LT((result.R_truth_estimate - T.linear()).norm(), 1e-12);
  EXPECT_LT((result.t_truth_estimate - T.translation()).norm(), 1e-12);
  EXPECT_LT(result.rmse_m, 1e-12);
  EXPECT_EQ(result.rank, 3);
}

TEST(Umeyama, GivesARotationAndNoReflectionForMirroredPoints) {
  std::vector<Eigen::Vector3d> mirrored = kCorners;
  for (Eigen::Vector3d& p : mirrored) p[0] = -p[0];
  const AlignmentResult result = umeyama(kCorners, mirrored, true);
  ASSERT_TRUE(result.outcome);
  EXPECT_NEAR(result.R_truth_estimate.determinant(), 1, 1e-12);
  EXPECT_GT(result.rmse_m, 0.1);
}

TEST(Umeyama, RotatesAPlaneTriangleOverInsteadOfMirroringIt) {
  // The triangles of Umeyama 1991, section V: mirror images in the plane, congruent in space.
  const AlignmentResult result =
      umeyama({{0, 0, 0}, {1, 0, 0}, {0, 2, 0}}, {{0, 0, 0}, {-1, 0, 0}, {0, 2, 0}}, true);
  ASSERT_TRUE(result.outcome);
  EXPECT_EQ(result.rank, 2);
  EXPECT_LT(result.rmse_m, 1e-12);
  const Eigen::Matrix3d half_turn = Eigen::Vector3d(-1, 1, -1).asDiagonal();
  EXPECT_LT((result.R_truth_estimate - half_turn).norm(), 1e-12);
}

TEST(Umeyama, SaysThatTwoPointsAreTooFew) {
  const AlignmentResult result = umeyama({{0, 0, 0}, {1, 0, 0}}, {{0, 0, 0}, {1, 0, 0}}, false);
  EXPECT_EQ(result.outcome.code, Outcome::Code::kTooFewData);
}

TEST(Umeyama, SaysThatALineLeavesTheRotationFreeButStillFitsIt) {
  const std::vector<Eigen::Vector3d> from = {{0, 0, 1}, {0, 0, 2}, {0, 0, 4}},
                                     to = {{1, 0, 0}, {2, 0, 0}, {4, 0, 0}};
  const AlignmentResult result = umeyama(from, to, false);
  EXPECT_EQ(result.outcome.code, Outcome::Code::kDegenerate);
  EXPECT_EQ(result.rank, 1);
  EXPECT_LT(result.rmse_m, 1e-12);
}

TEST(Umeyama, SaysThatCoincidentPointsGiveNothing) {
  const std::vector<Eigen::Vector3d> same(5, {1e3, -2e3, 7.7});
  const AlignmentResult result = umeyama(same, same, true);
  EXPECT_EQ(result.outcome.code, Outcome::Code::kDegenerate);
  EXPECT_EQ(result.rank, 0);
}

TEST(Umeyama, RefusesListsOfDifferentLength) {
  EXPECT_THROW((void)umeyama(kCorners, {}, false), ArgumentError);
}

TEST(Align, OriginPutsTheFirstPoseOnTheTruthAndFitsNothing) {
  const std::vector<FramePair> pairs = {
      pair_of(isometry({0, 0.5, 0}, {1, 2, 3}), isometry({0, 0, 0.2}, {0, 0, 0})),
      pair_of(isometry({0, 0.5, 0}, {1, 2, 9}), isometry({0, 0, 0.2}, {0, 0, 3}))};
  const AlignmentResult result = align(pairs, Alignment::kOrigin);
  ASSERT_TRUE(result.outcome);
  EXPECT_EQ(result.scale, 1);
  const Eigen::Isometry3d first = result.apply(*pairs[0].T_world_estimate);
  EXPECT_LT((first.matrix() - pairs[0].T_world_truth.matrix()).norm(), 1e-12);
  // The second pose lies 3 m along the first one's z, which points along (sin 0.5, 0, cos 0.5).
  const Eigen::Vector3d expected =
      Eigen::Vector3d(1, 2, 3) + 3 * Eigen::Vector3d(std::sin(0.5), 0, std::cos(0.5));
  EXPECT_LT((result.apply(*pairs[1].T_world_estimate).translation() - expected).norm(), 1e-12);
}

TEST(Align, ScaleIsFittedAboutTheFirstPose) {
  // Estimated steps 1 and 2 m for true ones of 2 and 5 m: s = (1*2 + 2*5) / (1 + 4) = 2.4.
  const std::vector<FramePair> pairs = {
      pair_of(isometry({0, 0, 0}, {7, 0, 0}), isometry({0, 0, 0}, {0, 4, 0})),
      pair_of(isometry({0, 0, 0}, {7, 0, 2}), isometry({0, 0, 0}, {0, 4, 1})),
      pair_of(isometry({0, 0, 0}, {7, 0, 5}), isometry({0, 0, 0}, {0, 4, 2}))};
  const AlignmentResult result = align(pairs, Alignment::kScale);
  ASSERT_TRUE(result.outcome);
  EXPECT_NEAR(result.scale, 2.4, 1e-12);
  EXPECT_LT(
      (result.apply(*pairs[0].T_world_estimate).translation() - Eigen::Vector3d(7, 0, 0)).norm(),
      1e-12);
}

TEST(Align, SaysThatAMotionlessEstimateHasNoScale) {
  const std::vector<FramePair> pairs = {
      pair_of(isometry({0, 0, 0}, {0, 0, 0}), isometry({0, 0, 0}, {0, 4, 0})),
      pair_of(isometry({0, 0, 0}, {0, 0, 2}), isometry({0, 0, 0}, {0, 4, 0}))};
  EXPECT_EQ(align(pairs, Alignment::kScale).outcome.code, Outcome::Code::kDegenerate);
}

TEST(Align, SaysThatNoPosedFrameIsTooFew) {
  for (const Alignment alignment :
       {Alignment::kNone, Alignment::kOrigin, Alignment::kSe3, Alignment::kSim3, Alignment::kScale})
    EXPECT_EQ(align({FramePair{}}, alignment).outcome.code, Outcome::Code::kTooFewData)
        << to_string(alignment);
}

TEST(Align, ADriveAgainstItselfHasNoErrorAtAll) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    const double size_m = std::pow(10, random.uniform(-3, 5));
    std::vector<FramePair> pairs;
    for (int i = 0; i < 3 + 10 * static_cast<int>(seed); ++i) {
      Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
      T.linear() = SO3::exp({random.normal(), random.normal(), random.normal()}).matrix();
      T.translation() = size_m * Eigen::Vector3d(random.normal(), random.normal(),
                                                 seed % 3 ? random.normal() : 0);
      pairs.push_back(pair_of(T, T));
    }
    for (const Alignment alignment : {Alignment::kNone, Alignment::kOrigin, Alignment::kSe3,
                                      Alignment::kSim3, Alignment::kScale}) {
      const AlignmentResult result = align(pairs, alignment);
      if (alignment != Alignment::kScale) {
        EXPECT_EQ(result.rmse_m, 0) << to_string(alignment);
      }
      EXPECT_LT(result.rmse_m, 1e-12 * size_m) << to_string(alignment);
    }
  }
}

}  // namespace umeyama_test
}  // namespace placegraph
