#include "apps/results/run_files.h"

#include <gtest/gtest.h>

#include "tests/support/random_map.h"

namespace placegraph::apps {
namespace {

/// The run of a map of places 0 to 3, of which nothing joins the last one to the others.
RunResult run_of_map(bool metric) {
  Random random(3);
  RunResult run;
  run.map = test::random_map(random).map;
  run.map.metric = metric;
  std::erase_if(run.map.place_graph.constraints, [](const RelativePoseConstraint& edge) {
    return edge.from == NodeId(3) || edge.to == NodeId(3);
  });
  return run;
}

TEST(RunPlot, HasTheUnitOfTheMap) {
  for (const bool metric : {false, true}) {
    const RunResult run = run_of_map(metric);
    const Plot plot = run_plot(run.map, run.map.trajectory_optimized(), nullptr, "a run");
    EXPECT_EQ(plot.unit, metric ? "m" : "units");
    EXPECT_EQ(plot.title, "a run");
  }
}

TEST(RunPlot, NumbersThePlacesOfTheMapsFrame) {
  const RunResult run = run_of_map(true);
  const Plot plot = run_plot(run.map, run.map.trajectory_optimized(), nullptr, "a run");
  EXPECT_EQ(plot.place_names, (std::vector<std::string>{"0", "1", "2"}));
  ASSERT_EQ(plot.places_m.size(), 3u);
  EXPECT_EQ(plot.places_m[2], run.map.place_graph.places[2].T_map_place.translation());
}

}  // namespace
}  // namespace placegraph::apps
