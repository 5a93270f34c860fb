#include "apps/eval/eval_edges.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/internal/core/json_text.h>
#include <placegraph/graph/pose_graph/constraint_source.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/results/run_map.h"

namespace placegraph::apps {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// True pose of the camera at each place's anchor frame, by node of the graph.
std::map<NodeId, SE3> true_places(const Trajectory& truth, const RunMap& map) {
  std::map<NodeId, SE3> result;
  for (const Place& place : map.graph.places) {
    const FrameId frame = map.anchor_frame(place);
    require(frame.value() >= 0 && frame.value() < static_cast<std::int64_t>(truth.size()),
            "place " + to_string(place.id) + " was seen in frame " + to_string(frame) +
                ", and the truth has " + std::to_string(truth.size()));
    if (const auto& pose = truth.poses[static_cast<std::size_t>(frame.value())].T_world_body)
      result.emplace(node_of_place(place.id), SE3(*pose));
  }
  return result;
}

}  // namespace

EvalEdgesResult eval_edges(const EvalEdgesArguments& arguments) {
  fs::path truth = arguments.truth;
  if (fs::is_directory(truth)) truth /= "poses.txt";
  const RunMap map = read_run_map(arguments.run);
  const auto nodes = true_places(read_trajectory(truth.string()), map);
  std::map<ConstraintSource, std::vector<RelativePoseConstraint>> by_source;
  for (const RelativePoseConstraint& edge : map.graph.constraints)
    by_source[edge.source].push_back(edge);
  EvalEdgesResult result;
  for (const auto& [source, edges] : by_source)
    result.by_source[source] = edge_consistency(edges, nodes);
  return result;
}

std::string to_text(const EvalEdgesResult& result) {
  std::string text = "source      edges  unknown  mean NEES  median  beyond 99 %\n";
  for (const auto& [source, c] : result.by_source)
    text += fmt::format("{:<10} {:>6} {:>8} {:>10.3f} {:>7.3f} {:>10.1f} %\n", to_string(source),
                        c.edges, c.unknown, c.mean_nees, c.median_nees, 100 * c.share_beyond_99);
  return text;
}

std::string to_json(const EvalEdgesResult& result) {
  json report = json::object();
  for (const auto& [source, c] : result.by_source)
    report[to_string(source)] = {{"edges", c.edges},
                                 {"unknown", c.unknown},
                                 {"mean_nees", c.mean_nees},
                                 {"median_nees", c.median_nees},
                                 {"share_beyond_99", c.share_beyond_99}};
  return json_text(report, 1);
}

}  // namespace placegraph::apps
