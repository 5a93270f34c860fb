#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/places/place_optimizer.h>

#include "tests/support/place_links.h"

namespace placegraph {
namespace place_optimizer_test {

using namespace test;
using Kind = PlaceConstraint::Kind;

PoseNode node(int place, const SE3& T_map_place = SE3()) {
  return {NodeId(place), Pose(T_map_place), false};
}

PlaceConstraint constraint(Kind kind, std::int64_t number, std::int64_t from, std::int64_t to,
                           const SE3& T_from_to, double sigma_m = 0.1) {
  RelativePoseConstraint measured;
  measured.from = NodeId(from);
  measured.to = NodeId(to);
  measured.T_from_to = Pose(T_from_to);
  measured.information = information_of(sigma_m, 0.1 * sigma_m);
  return {{kind, number}, measured};
}

/// The end of the other's constraint lies in the same place by now.
PlaceConstraint gone(Kind kind, std::int64_t number) { return {{kind, number}, std::nullopt}; }

/// Three places in a row, 1 m apart, joined by two links.
class PlaceOptimizerTest : public ::testing::Test {
 protected:
  PlaceOptimizerTest() {
    (void)optimizer.begin(
        {node(0), node(1, kStep), node(2, kStep * kStep)},
        {constraint(Kind::kLink, 1, 0, 1, kStep), constraint(Kind::kLink, 2, 1, 2, kStep)});
  }
  void expect_at(std::int64_t place, const SE3& T_map_place, double tolerance_m = 1e-4) {
    const IncrementalStep step = optimizer.finish();
    EXPECT_TRUE(step.outcome) << step.outcome.reason;
    EXPECT_LT(distance_m(rigid_part(optimizer.S_map_place(PlaceId(place))), T_map_place),
              tolerance_m)
        << place;
  }

  static inline const SE3 kStep = pose({0, 0, 0}, {0, 0, 1}), kLonger = pose({0, 0, 0}, {0, 0, 2});
  PlaceOptimizer optimizer{IncrementalOptions()};
};

TEST_F(PlaceOptimizerTest, BeginsWherePlacesStand) {
  EXPECT_EQ(optimizer.kind(), PoseKind::kSE3);
  EXPECT_TRUE(optimizer.knows(PlaceId(2)));
  EXPECT_FALSE(optimizer.knows(PlaceId(3)));
  expect_at(0, SE3());
  expect_at(2, kStep * kStep);
  EXPECT_THROW((void)optimizer.S_map_place(PlaceId(3)), ArgumentError);
  EXPECT_THROW((void)optimizer.relative_covariance(PlaceId(0), PlaceId(3)), ArgumentError);
}

TEST_F(PlaceOptimizerTest, ALinkThatIsMeasuredBetterTakesTheOldOnesPlace) {
  (void)optimizer.follow({}, {constraint(Kind::kLink, 1, 0, 1, kLonger)});
  expect_at(1, kLonger);
  expect_at(2, kLonger * kStep);
}

TEST_F(PlaceOptimizerTest, NewPlacesFollowWithTheirLinks) {
  (void)optimizer.follow({node(3, kStep)}, {constraint(Kind::kLink, 3, 2, 3, kLonger)});
  expect_at(3, kStep * kStep * kLonger);
  // Their number is known: the same link measured anew does not count twice.
  (void)optimizer.follow({}, {constraint(Kind::kLink, 3, 2, 3, kStep)});
  expect_at(3, kStep * kStep * kStep);
}

TEST_F(PlaceOptimizerTest, LinksLoopsAndMotionsOfOneNumberAreThree) {
  (void)optimizer.follow(
      {}, {constraint(Kind::kLoop, 1, 0, 1, kLonger), constraint(Kind::kMotion, 1, 0, 1, kLonger)});
  expect_at(1, pose({0, 0, 0}, {0, 0, 5. / 3}));  // the mean of 1, 2 and 2 m
}

TEST_F(PlaceOptimizerTest, AnEndThatMovesToAnotherPlaceTakesTheConstraintAlong) {
  (void)optimizer.follow({}, {constraint(Kind::kLoop, 0, 0, 1, kLonger, 1e-3)});
  expect_at(1, kLonger, 1e-3);
  (void)optimizer.follow({}, {constraint(Kind::kLoop, 0, 0, 2, kLonger * kStep, 1e-3)});
  expect_at(2, kLonger * kStep, 1e-3);
  expect_at(1, pose({0, 0, 0}, {0, 0, 1.5}), 1e-3);  // halfway between the two links' wishes
  // It is found by its new number afterwards.
  (void)optimizer.follow({}, {gone(Kind::kLoop, 0)});
  expect_at(1, kStep);
  expect_at(2, kStep * kStep);
}

TEST_F(PlaceOptimizerTest, AConstraintWithinOnePlaceCountsNoMore) {
  (void)optimizer.follow({}, {constraint(Kind::kLoop, 0, 0, 1, kLonger, 1e-3)});
  (void)optimizer.follow({}, {gone(Kind::kLoop, 0), gone(Kind::kLoop, 7)});
  expect_at(1, kStep);
  (void)optimizer.follow({}, {constraint(Kind::kLoop, 0, 0, 1, kLonger, 1e-3)});
  expect_at(1, kLonger, 1e-3);
}

TEST_F(PlaceOptimizerTest, CovarianceOfThePlacesGrowsAlongTheLinks) {
  const Matrix7d one = optimizer.relative_covariance(PlaceId(0), PlaceId(1)),
                 two = optimizer.relative_covariance(PlaceId(0), PlaceId(2));
  EXPECT_NEAR(one(2, 2), 0.01, 1e-6);
  EXPECT_NEAR(two(2, 2), 0.02, 1e-6);
  EXPECT_NEAR(two(0, 0), 0.02 + 1e-4, 1e-6);  // the first link's turn swings the second by 1 m
  EXPECT_TRUE(one.row(6).isZero());
  EXPECT_TRUE(one.col(6).isZero());
}

TEST_F(PlaceOptimizerTest, BeginningAnewForgetsWhatWasKnown) {
  (void)optimizer.begin({node(5), node(6, kStep)}, {constraint(Kind::kLink, 6, 5, 6, kStep)});
  EXPECT_FALSE(optimizer.knows(PlaceId(0)));
  // The link of this key joined places that are gone: it is a new one.
  (void)optimizer.follow({}, {constraint(Kind::kLink, 1, 5, 6, kLonger)});
  expect_at(6, pose({0, 0, 0}, {0, 0, 1.5}));
}

TEST_F(PlaceOptimizerTest, ResettingForgetsPlacesAndConstraints) {
  optimizer.reset();
  EXPECT_FALSE(optimizer.kind());
  EXPECT_FALSE(optimizer.knows(PlaceId(0)));
  // The same keys are new ones, whatever their ends.
  (void)optimizer.follow({node(0), node(1)}, {constraint(Kind::kLink, 1, 0, 1, kLonger)});
  expect_at(1, kLonger);
}

TEST_F(PlaceOptimizerTest, PlacesOfUnknownScaleAreSimilarities) {
  const Sim3 S_0_1(SO3(), Eigen::Vector3d(0, 0, 1), 2);
  RelativePoseConstraint link;
  link.from = NodeId(0);
  link.to = NodeId(1);
  link.T_from_to = Pose(S_0_1);
  link.information = Matrix7d::Identity() * 100;
  (void)optimizer.begin({{NodeId(0), Pose(Sim3()), false}, {NodeId(1), Pose(Sim3()), false}},
                        {{{Kind::kLink, 1}, link}});
  EXPECT_EQ(optimizer.kind(), PoseKind::kSim3);
  (void)optimizer.finish();
  EXPECT_NEAR(optimizer.S_map_place(PlaceId(1)).scale(), 2, 1e-4);
  EXPECT_NEAR(optimizer.relative_covariance(PlaceId(0), PlaceId(1))(6, 6), 0.01, 1e-4);
}

}  // namespace place_optimizer_test
}  // namespace placegraph
