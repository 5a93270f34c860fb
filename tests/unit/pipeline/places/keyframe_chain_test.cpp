#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/places/keyframe_chain.h>

#include "tests/support/place_links.h"

namespace placegraph {
namespace keyframe_chain_test {

using namespace test;

constexpr double kRounding = 1e-12;

/// Keyframes 0, 1, 2 in one run of tracking; 3 hangs on 1 and begins another one, with 4.
KeyframeChain two_track_segments(bool first_known = true, bool second_known = true) {
  KeyframeChain chain;
  chain.add(KeyframeId(0), std::nullopt, first_known);
  chain.add(KeyframeId(1), link(0, kShort));
  chain.add(KeyframeId(2), link(1, kLong));
  KeyframeLink other = link(1, kLong);
  other.source = ConstraintSource::kOther;
  other.scale = 3;
  other.sigma_log_scale = 0.1;
  chain.add(KeyframeId(3), other, second_known);
  chain.add(KeyframeId(4), link(3, kShort));
  return chain;
}

TEST(KeyframeChain, TheMotionBetweenTwoKeyframesIsThatOfTheLinksBetweenThem) {
  const KeyframeChain chain = two_track_segments();
  EXPECT_LT(distance_m(chain.T_a_b(KeyframeId(0), KeyframeId(2)), kShort * kLong), kRounding);
  EXPECT_LT(distance_m(chain.T_a_b(KeyframeId(2), KeyframeId(0)), (kShort * kLong).inverse()),
            kRounding);
  EXPECT_LT(distance_m(chain.odometry(KeyframeId(1), KeyframeId(2))->T_a_b, kLong), kRounding);
}

TEST(KeyframeChain, ThePathIsAsLongAsItsLinksInEitherDirection) {
  const KeyframeChain chain = two_track_segments();
  const double expected = kShort.translation().norm() + kLong.translation().norm();
  EXPECT_NEAR(chain.odometry(KeyframeId(0), KeyframeId(2))->path_length, expected, kRounding);
  EXPECT_NEAR(chain.odometry(KeyframeId(2), KeyframeId(0))->path_length, expected, kRounding);
  EXPECT_NEAR(chain.odometry(KeyframeId(2), KeyframeId(1))->path_length, kLong.translation().norm(),
              kRounding);
}

TEST(KeyframeChain, ALinkThatIsNoOdometryBeginsARun) {
  const KeyframeChain chain = two_track_segments(true, false);
  EXPECT_TRUE(chain.has_odometry(KeyframeId(2)));
  EXPECT_FALSE(chain.has_odometry(KeyframeId(0)));
  EXPECT_FALSE(chain.has_odometry(KeyframeId(3)));
  EXPECT_EQ(chain.at(KeyframeId(2)).track_segment, 0);
  EXPECT_EQ(chain.at(KeyframeId(4)).track_segment, 1);
  EXPECT_FALSE(chain.odometry(KeyframeId(1), KeyframeId(3)));
  EXPECT_FALSE(chain.odometry(KeyframeId(0), KeyframeId(9)));
  EXPECT_LT(distance_m(chain.T_a_b(KeyframeId(3), KeyframeId(4)), kShort), kRounding);
  EXPECT_TRUE(chain.scale_known(KeyframeId(2)));
  EXPECT_FALSE(chain.scale_known(KeyframeId(4)));
  EXPECT_FALSE(chain.all_scales_known());
  EXPECT_TRUE(two_track_segments().all_scales_known());
}

TEST(KeyframeChain, ANewerLinkMovesAllKeyframesThatFollow) {
  KeyframeChain chain = two_track_segments();
  const SE3 newer = pose({0, 0.03, 0}, {0, 0, 2});
  chain.update_link(KeyframeId(1), newer);
  EXPECT_LT(distance_m(chain.T_a_b(KeyframeId(0), KeyframeId(2)), newer * kLong), kRounding);
  EXPECT_LT(distance_m(chain.T_a_b(KeyframeId(1), KeyframeId(2)), kLong), kRounding);
  EXPECT_NEAR(chain.odometry(KeyframeId(0), KeyframeId(2))->path_length,
              2 + kLong.translation().norm(), kRounding);
  EXPECT_LT(distance_m(chain.T_a_b(KeyframeId(3), KeyframeId(4)), kShort),
            kRounding);  // of another run
}

TEST(KeyframeChain, TheCovarianceOfALinkIsTheInverseOfItsInformation) {
  KeyframeChain chain = two_track_segments();
  EXPECT_NEAR(chain.at(KeyframeId(1)).link_covariance(0, 0), 0.05 * 0.05, kRounding);
  chain.inform_link(KeyframeId(1), information_of(0.2, 0.03), 0.04);
  Vector7d expected;
  expected << 0.04, 0.04, 0.04, 0.0009, 0.0009, 0.0009, 0.0016;
  const Matrix7d difference =
      chain.at(KeyframeId(1)).link_covariance - Matrix7d(expected.asDiagonal().toDenseMatrix());
  EXPECT_LT(difference.norm(), kRounding);
  EXPECT_EQ(chain.at(KeyframeId(0)).link_covariance.norm(), 0);
}

TEST(KeyframeChain, RescalingARunMultipliesItsLengthsAndLeavesOthersAsTheyAre) {
  KeyframeChain chain = two_track_segments(false, false);
  chain.inform_link(KeyframeId(1), information_of(0.2, 0.03), 0.04);
  chain.rescale(KeyframeId(0), 2);
  EXPECT_TRUE(chain.scale_known(KeyframeId(2)));
  EXPECT_FALSE(chain.scale_known(KeyframeId(4)));
  EXPECT_LT(distance_m(chain.T_a_b(KeyframeId(0), KeyframeId(2)), (kShort * kLong).scaled(2)),
            kRounding);
  EXPECT_NEAR(chain.odometry(KeyframeId(0), KeyframeId(1))->path_length,
              2 * kShort.translation().norm(), kRounding);
  EXPECT_LT(distance_m(chain.T_a_b(KeyframeId(3), KeyframeId(4)), kShort), kRounding);
  // Standard deviations of lengths grow with them, angles are as they were.
  EXPECT_NEAR(chain.at(KeyframeId(1)).link_covariance(0, 0), 0.4 * 0.4, 1e-9);
  EXPECT_NEAR(chain.at(KeyframeId(1)).link_covariance(5, 5), 0.03 * 0.03, 1e-9);
  EXPECT_EQ(chain.at(KeyframeId(1)).link_covariance(6, 6),
            0);  // no scale drifts where it is measured
  // The link to the other run is in the first one's lengths, its information in the second one's.
  EXPECT_LT(distance_m(chain.at(KeyframeId(3)).link->T_from_this, kLong.scaled(2)), kRounding);
  EXPECT_NEAR(chain.at(KeyframeId(3)).link->scale, 6, kRounding);
  EXPECT_NEAR(chain.at(KeyframeId(3)).link->sigma_log_scale, 0.1, kRounding);
  EXPECT_NEAR(chain.at(KeyframeId(3)).link_covariance(0, 0), 0.05 * 0.05, 1e-9);
}

TEST(KeyframeChain, RescalingTheRunThatHangsOnAnotherLeavesTheLinkBetweenThem) {
  KeyframeChain chain = two_track_segments(true, false);
  chain.rescale(KeyframeId(3), 3);
  EXPECT_TRUE(chain.all_scales_known());
  EXPECT_LT(distance_m(chain.at(KeyframeId(3)).link->T_from_this, kLong), kRounding);
  EXPECT_NEAR(chain.at(KeyframeId(3)).link->scale, 1, kRounding);
  EXPECT_NEAR(chain.at(KeyframeId(3)).link_covariance(0, 0), 0.15 * 0.15, 1e-9);
  EXPECT_LT(distance_m(chain.T_a_b(KeyframeId(3), KeyframeId(4)), kShort.scaled(3)), kRounding);
  EXPECT_LT(distance_m(chain.T_a_b(KeyframeId(0), KeyframeId(2)), kShort * kLong), kRounding);
}

TEST(KeyframeChain, ASavedChainIsTheSameWhenItIsRestored) {
  const KeyframeChain chain = two_track_segments(true, false);
  std::vector<PlaceHistory::Keyframe> saved;
  for (const auto& [id, keyframe] : chain.keyframes())
    saved.push_back({id, KeyframeId(0), keyframe.track_segment, keyframe.link});
  const KeyframeChain restored(saved, chain.scale_known());
  EXPECT_LT(distance_m(restored.T_a_b(KeyframeId(0), KeyframeId(2)),
                       chain.T_a_b(KeyframeId(0), KeyframeId(2))),
            kRounding);
  EXPECT_EQ(restored.odometry(KeyframeId(0), KeyframeId(2))->path_length,
            chain.odometry(KeyframeId(0), KeyframeId(2))->path_length);
  EXPECT_EQ(restored.at(KeyframeId(3)).link_covariance, chain.at(KeyframeId(3)).link_covariance);
  EXPECT_FALSE(restored.scale_known(KeyframeId(4)));
}

TEST(KeyframeChain, RefusesWhatContradictsItself) {
  KeyframeChain chain = two_track_segments();
  EXPECT_THROW(chain.add(KeyframeId(2), std::nullopt), ArgumentError);
  EXPECT_THROW(chain.add(KeyframeId(5), link(9, kLong)), ArgumentError);
  EXPECT_FALSE(chain.contains(KeyframeId(5)));
  EXPECT_THROW(chain.update_link(KeyframeId(0), kShort), ArgumentError);
  EXPECT_THROW(chain.inform_link(KeyframeId(0), information_of(1, 1), 0), ArgumentError);
  EXPECT_THROW(KeyframeChain({{KeyframeId(0), KeyframeId(0), 1, std::nullopt}}, {true}),
               ArgumentError);  // no run 1
  EXPECT_THROW(KeyframeChain({{KeyframeId(0), KeyframeId(0), 0, link(5, kLong)}}, {true}),
               ArgumentError);
}

}  // namespace keyframe_chain_test
}  // namespace placegraph
