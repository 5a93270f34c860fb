#include <gtest/gtest.h>
#include <placegraph/pipeline/places/place_constraints.h>
#include <placegraph/pipeline/places/place_mapper.h>

#include "tests/support/scenes/poses.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace place_graph_test {

using namespace test;

/// Random steps of one run of tracking, some with loops to earlier keyframes.
struct Walk {
  std::vector<KeyframeLink> links;
  std::vector<Loop> loops;

  explicit Walk(Random& random) {
    std::vector<SE3> poses{SE3()};
    for (std::int64_t i = 1; i < 20; ++i) {
      const SE3 T_last_this = uniform_motion(random, 3, 0.5);
      poses.push_back(poses.back() * T_last_this);
      links.push_back({KeyframeId(i - 1), T_last_this * uniform_motion(random, 0.03, 0.005)});
      for (int k = 0; k < 6; ++k) links.back().information(k, k) = random.uniform(100, 1e4);
      if (i < 3 || random.uniform() < 0.6) continue;
      const std::int64_t match = random.index(static_cast<int>(i) - 1);
      Loop loop{KeyframeId(i), KeyframeId(match),
                poses[match].inverse() * poses[i] * uniform_motion(random, 0.03, 0.005)};
      for (int k = 0; k < 6; ++k) loop.information(k, k) = random.uniform(100, 1e4);
      loops.push_back(loop);
    }
  }
  /// All lengths times `factor`.
  PlaceMapper mapped(const SE3& T_map_first, double factor = 1) const {
    PlaceMapper mapper(PlaceOptions{});
    mapper.add_keyframe(KeyframeId(0), std::nullopt, T_map_first, 10 * factor);
    Vector7d unit = Vector7d::Ones();
    unit.head<3>().setConstant(1 / factor);
    for (std::size_t i = 0; i < links.size(); ++i) {
      KeyframeLink link = links[i];
      link.T_from_this = link.T_from_this.scaled(factor);
      link.information =
          unit.head<6>().asDiagonal() * link.information * unit.head<6>().asDiagonal();
      mapper.add_keyframe(KeyframeId(static_cast<std::int64_t>(i) + 1), link, {}, 10 * factor);
    }
    for (Loop loop : loops) {
      loop.T_match_query = loop.T_match_query.scaled(factor);
      loop.information = unit.asDiagonal() * loop.information * unit.asDiagonal();
      mapper.add_loop(loop);
    }
    EXPECT_TRUE(mapper.finish().outcome);
    return mapper;
  }
};

/// The optimizer stops where little is left to gain: what it leaves may differ by a fifth of the
/// smallest deviation of a link, 1 / sqrt(1e4), of translation [m], rotation [rad] or log scale.
constexpr double kLeft = 0.2 * 1e-2;

TEST(PlaceGraphLaw, RotatingTheWorldRotatesAllPoses) {
  Random random = seeded_random(3);
  for (int trial = 0; trial < 10; ++trial) {
    const Walk walk(random);
    const SE3 T_new_map = uniform_motion(random, 30, 2);
    const PlaceMapper here = walk.mapped(SE3()), there = walk.mapped(T_new_map);
    for (std::int64_t id = 0; id < 20; ++id) {
      EXPECT_EQ(here.place_of(KeyframeId(id)), there.place_of(KeyframeId(id)))
          << trial << " " << id;
      EXPECT_LT(difference(Sim3(T_new_map) * here.S_map_keyframe(KeyframeId(id)),
                           there.S_map_keyframe(KeyframeId(id))),
                kLeft)
          << trial << " " << id;
    }
  }
}

TEST(PlaceGraphLaw, AnotherUnitOfLengthScalesAllPositions) {
  Random random = seeded_random(4);
  for (int trial = 0; trial < 10; ++trial) {
    const Walk walk(random);
    const double factor = random.uniform(0.5, 2);
    const PlaceMapper metres = walk.mapped(SE3()), other = walk.mapped(SE3(), factor);
    for (std::int64_t id = 0; id < 20; ++id) {
      EXPECT_EQ(metres.place_of(KeyframeId(id)), other.place_of(KeyframeId(id)))
          << trial << " " << id;
      EXPECT_LT(difference(Sim3(metres.T_map_keyframe(KeyframeId(id)).scaled(factor)),
                           other.S_map_keyframe(KeyframeId(id))),
                2 * kLeft)
          << trial << " " << id;
    }
  }
}

/// A chain of links measured in another unit is the chain rescaled.
TEST(PlaceGraphLaw, RescalingAChainIsMeasuringItInAnotherUnit) {
  Random random = seeded_random(5);
  for (int trial = 0; trial < 20; ++trial) {
    const Walk walk(random);
    const double factor = random.uniform(0.2, 5);
    KeyframeChain rescaled, measured;
    rescaled.add(KeyframeId(0), std::nullopt, false);
    measured.add(KeyframeId(0), std::nullopt);
    for (std::size_t i = 0; i < walk.links.size(); ++i) {
      KeyframeLink link = walk.links[i];
      rescaled.add(KeyframeId(static_cast<std::int64_t>(i) + 1), link);
      link.T_from_this = link.T_from_this.scaled(factor);
      measured.add(KeyframeId(static_cast<std::int64_t>(i) + 1), link);
    }
    rescaled.rescale(KeyframeId(0), factor);
    for (std::int64_t id = 0; id < 20; ++id)
      EXPECT_LT(difference(Sim3(rescaled.T_a_b(KeyframeId(0), KeyframeId(id))),
                           Sim3(measured.T_a_b(KeyframeId(0), KeyframeId(id)))),
                1e-9);
    EXPECT_NEAR(rescaled.odometry(KeyframeId(0), KeyframeId(19))->path_length,
                measured.odometry(KeyframeId(0), KeyframeId(19))->path_length, 1e-9);
  }
}

/// Merging two places moves no keyframe, and separating them leaves all as it was.
TEST(PlaceGraphLaw, SeparatingUndoesMerging) {
  Random random = seeded_random(6);
  for (int trial = 0; trial < 50; ++trial) {
    const Walk walk(random);
    KeyframeChain chain;
    PlacePartition partition;
    for (std::int64_t id = 0; id < 6; ++id) {
      chain.add(KeyframeId(id), id == 0 ? std::nullopt : std::optional(walk.links[id - 1]));
      const SE3 T = uniform_motion(random, 10, 1);
      partition.found(KeyframeId(id), Sim3(T.rotation(), T.translation(), random.uniform(0.5, 2)),
                      0, 3);
    }
    std::vector<Sim3> before;
    for (std::int64_t id = 0; id < 6; ++id)
      before.push_back(partition.S_map_keyframe(chain, KeyframeId(id)));
    const auto unmoved = [&] {
      for (std::int64_t id = 0; id < 6; ++id)
        EXPECT_LT(difference(partition.S_map_keyframe(chain, KeyframeId(id)), before[id]), 1e-9)
            << trial;
    };
    partition.merge(PlaceId(3), PlaceId(5), random.uniform(0, 1) * Matrix7d::Identity());
    const Matrix7d covariance = partition.segments().at(KeyframeId(5)).covariance;
    partition.merge(PlaceId(1), PlaceId(3), random.uniform(0, 1) * Matrix7d::Identity());
    unmoved();
    EXPECT_EQ(partition.place_of(KeyframeId(5)), PlaceId(1));
    partition.separate(1);
    unmoved();
    EXPECT_EQ(partition.place_of(KeyframeId(5)), partition.place_of(KeyframeId(3)));
    EXPECT_EQ(partition.segments().at(KeyframeId(5)).covariance, covariance);
    partition.separate(0);
    unmoved();
    EXPECT_EQ(partition.places().size(), 6u);
    for (const auto& [anchor, segment] : partition.segments()) {
      EXPECT_LT(difference(segment.S_place_segment, Sim3()), 1e-9);
      EXPECT_EQ(segment.covariance.norm(), 0);
    }
  }
}

}  // namespace place_graph_test
}  // namespace placegraph
