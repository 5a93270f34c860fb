#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>

#include "tests/support/place_links.h"

namespace placegraph {
namespace place_history_test {

using namespace test;

/// A square with a loop that merges its two ends.
PlaceMapper looped_square() {
  PlaceMapper mapper = square(true);
  mapper.add_loop(loop(5, 0, kShort, 0.001, 0.0001));
  (void)mapper.optimize(KeyframeId(100));
  return mapper;
}

void expect_same(const PlaceGraph& a, const PlaceGraph& b, double tolerance) {
  ASSERT_EQ(a.places.size(), b.places.size());
  for (std::size_t i = 0; i < a.places.size(); ++i) {
    EXPECT_EQ(a.places[i].id, b.places[i].id);
    EXPECT_EQ(a.places[i].members.size(), b.places[i].members.size());
    EXPECT_LT(distance_m(a.places[i].T_map_place, b.places[i].T_map_place), tolerance);
  }
  ASSERT_EQ(a.constraints.size(), b.constraints.size());
  for (std::size_t i = 0; i < a.constraints.size(); ++i)
    EXPECT_LT((a.constraints[i].information - b.constraints[i].information).norm(),
              1e-9 * a.constraints[i].information.norm());
}

TEST(PlaceHistory, AMapperGoesOnWhereAnotherStood) {
  PlaceMapper first = looped_square();
  PlaceOptions options;
  PlaceMapper second(options, {}, first.places(), first.history());
  expect_same(first.place_graph(), second.place_graph(), 1e-12);
  for (PlaceMapper* mapper : {&first, &second}) {
    mapper->add_keyframe(KeyframeId(6), link(5, kLong), {}, kDepth_m);
    mapper->add_keyframe(KeyframeId(7), link(6, kLong), {}, kDepth_m);
    mapper->add_loop(loop(7, 1, SE3(), 0.3, 0.05));
  }
  EXPECT_NEAR(first.odometry(KeyframeId(1), KeyframeId(7))->path_length,
              second.odometry(KeyframeId(1), KeyframeId(7))->path_length, 1e-9);
  // Both iterate to the end of the same graph: to the optimizer's tolerance.
  expect_same(optimized(first), optimized(second), 1e-4);
}

TEST(PlaceHistory, ConstraintsArePublishedOnceAndWhenTheyChange) {
  PlaceMapper mapper = square(false);
  EXPECT_EQ(mapper.take_constraint_changes().size(), 4u);
  EXPECT_TRUE(mapper.take_constraint_changes().empty());
  mapper.add_loop(loop(5, 0, kShort, 0.01, 0.001));
  const auto changes = mapper.take_constraint_changes();
  ASSERT_FALSE(changes.empty());
  EXPECT_EQ(changes.back().constraint->source, ConstraintSource::kLoop);
  // All that is published adds up to the graph, also after a merger has taken constraints away.
  PlaceMapper merging = square(true);
  std::map<std::pair<int, std::int64_t>, RelativePoseConstraint> known;
  const auto take_over = [&] {
    for (const auto& change : merging.take_constraint_changes()) {
      known.erase({change.kind, change.number});
      if (change.constraint) known[{change.kind, change.number}] = *change.constraint;
    }
  };
  take_over();
  merging.add_loop(loop(5, 0, kShort, 0.001, 0.0001));
  (void)merging.optimize(KeyframeId(100));
  take_over();
  const PlaceGraph graph = merging.place_graph();
  ASSERT_EQ(known.size(), graph.constraints.size());
  std::size_t i = 0;
  for (const auto& [key, constraint] : known) {
    EXPECT_EQ(constraint.from, graph.constraints[i].from);
    EXPECT_EQ(constraint.to, graph.constraints[i].to);
    EXPECT_EQ(constraint.information, graph.constraints[i++].information);
  }
}

TEST(PlaceHistory, WhatContradictsItselfIsRefused) {
  PlaceMapper mapper = looped_square();
  const std::vector<Place> places = mapper.places();
  const auto refused = [&](PlaceHistory history) {
    EXPECT_THROW(PlaceMapper({}, {}, places, history), ArgumentError);
  };
  PlaceHistory history = mapper.history();
  history.places.pop_back();
  refused(history);
  history = mapper.history();
  history.segments.front().place = PlaceId(99);
  refused(history);
  history = mapper.history();
  history.keyframes.back().segment = KeyframeId(99);
  refused(history);
  history = mapper.history();
  history.loops.front().query = KeyframeId(99);
  refused(history);
}

}  // namespace place_history_test
}  // namespace placegraph
