#include <gtest/gtest.h>
#include <placegraph/pipeline/exports/place_tables.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include <placegraph/pipeline/results/run_files.h>
#include "tests/support/random_map.h"

namespace placegraph {
namespace run_files_test {

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

TEST(LoopsCsv, HasALineForEveryCandidate) {
  Map map;
  map.loops = {{FrameId(9), FrameId(1), 33, LoopStage::kAccepted, SE3(), LoopModel::kPoints3d2d, 4,
                0.75, 0.5},
               {FrameId(10), FrameId(2), 0, LoopStage::kGeometry, SE3()}};
  EXPECT_EQ(loops_csv(map),
            "query,match,inliers,accepted,stage,model,lines,likeness,probability\n"
            "9,1,33,1,accepted,3d2d,4,0.75,0.5\n10,2,0,0,geometry,none,0,0,0\n");
}

// The median of the lengths of e in standard deviations, divided by the root of the coordinates.
TEST(DescribeMotion, IsTheMedianDeviationOfOtherSources) {
  RunResult run = run_of_map(true);
  PlaceGraph& graph = run.map.place_graph;
  EXPECT_EQ(describe_motion(graph),
            (nlohmann::json{{"constraints", 0}, {"median_deviation", nullptr}}));
  for (const double off_m : {0.9, 0.0, 0.3}) {
    RelativePoseConstraint& edge = graph.constraints.emplace_back();
    edge.from = NodeId(0), edge.to = NodeId(1);
    const SE3 T_from_to = graph.places[0].T_map_place.inverse() * graph.places[1].T_map_place;
    edge.T_from_to = T_from_to * SE3(SO3(), Eigen::Vector3d(0, off_m, 0));
    edge.information = 100 * Matrix6d::Identity();  // sigma 0.1 m
    edge.source = ConstraintSource::kOther;
  }
  const nlohmann::json motion = describe_motion(graph);
  EXPECT_EQ(motion["constraints"], 3);
  EXPECT_NEAR(motion["median_deviation"].get<double>(), 3 / std::sqrt(6), 1e-9);
}

TEST(DescribeRun, CountsFramesWithAndWithoutAPose) {
  RunResult run = run_of_map(true);
  run.sensor = Sensor::kStereo;
  run.lens_k1 = -0.25;
  const Trajectory optimized = run.map.trajectory_optimized();
  const nlohmann::json described = describe_run(run, optimized);
  EXPECT_EQ(described["sensor"], "stereo");
  EXPECT_EQ(described["lens_k1"], -0.25);
  EXPECT_EQ(described["frames"], run.map.frames.size());
  EXPECT_EQ(described["posed"].get<std::size_t>() + described["lost_frames"].size(),
            run.map.frames.size());
  for (const nlohmann::json& lost : described["lost_frames"])
    EXPECT_FALSE(optimized.poses.at(lost.get<std::size_t>()).T_world_body);
  EXPECT_EQ(described["components"], 2);
  EXPECT_EQ(described["loops_checked"], 2);
  EXPECT_EQ(described["loops_accepted"], 1);
  const nlohmann::json& health = described["frame_health"];
  ASSERT_EQ(health["confidence"].size(), run.map.frames.size());
  for (std::size_t i = 0; i < run.map.frames.size(); ++i) {
    const std::optional<double>& confidence = run.map.frames[i].confidence;
    ASSERT_EQ(health["confidence"][i].is_null(), !confidence) << i;
    if (!confidence) continue;
    EXPECT_NEAR(health["confidence"][i].get<double>(), *confidence, 0.005 + 1e-9);  // hundredths
  }
  EXPECT_EQ(health["reasons"][0], (nlohmann::json{{"frame", 5}, {"reason", "only 'few' points"}}));
}

// What a run writes beside graph.g2o has all that is known of its places.
TEST(PlacesJson, ListsPlacesWithTheirMembersAndFrames) {
  const Map map = run_of_map(true).map;
  const nlohmann::json document = nlohmann::json::parse(places_json(map));
  ASSERT_EQ(document["places"].size(), map.place_graph.places.size());
  std::size_t members = 0;
  for (std::size_t i = 0; i < map.place_graph.places.size(); ++i) {
    const Place& place = map.place_graph.places[i];
    EXPECT_EQ(document["places"][i]["id"], place.id.value());
    EXPECT_EQ(document["places"][i]["labels"], nlohmann::json(place.labels));
    for (const nlohmann::json& member : document["places"][i]["members"]) {
      const Keyframe& keyframe = map.keyframes.at(member["keyframe"].get<std::size_t>());
      EXPECT_EQ(member["frame"], keyframe.frame.value());
      EXPECT_EQ(keyframe.place, place.id);
      ++members;
    }
  }
  EXPECT_EQ(members, map.keyframes.size());
  EXPECT_EQ(document["edges"].size(), map.place_graph.constraints.size());
  ASSERT_EQ(document["loops"].size(), 1U);
  EXPECT_EQ(document["loops"][0]["match_frame"], 1);
}

}  // namespace run_files_test
}  // namespace placegraph
