#include "apps/map/queries/georeference_files.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/pose_graph/node_index.h>
#include <placegraph/graph/pose_graph/rigid_graph.h>
#include <placegraph/graph/text/csv_text.h>
#include <placegraph/graph/text/id_format.h>
#include <placegraph/io/files/json_file.h>
#include <placegraph/io/graphs/g2o.h>
#include <placegraph/io/graphs/pose_graph_file.h>
#include <placegraph/io/map/map_database.h>
#include <placegraph/io/sensors/oxts_file.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/results/run_map.h"

namespace placegraph::apps {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Allowed change of the scale of a monocular map from one place to the next.
constexpr double kScaleSigma = 0.02;

/// Members of the places, each once: the time of a keyframe at its place.
std::vector<NodeVisit> read_visits(const std::string& path) {
  std::vector<NodeVisit> visits;
  take_json(path, "run", [&](const json& document) {
    for (const json& place : document.at("places"))
      for (const json& member : place.at("members"))
        visits.push_back({member.at("stamp_ns").get<std::int64_t>(), place.at("id").get<NodeId>()});
  });
  return visits;
}

Sim3 with_scale(const Pose& pose) { return Sim3(std::get<SE3>(pose)); }

/// The same graph with an unobservable scale at every node. A graph that has scales already is
/// returned unchanged.
PoseGraph similarity_graph(const PoseGraph& graph) {
  PoseGraph out = graph;
  if (graph.kind() == PoseKind::kSim3) return out;
  for (PoseNode& node : out.nodes) node.T_world_node = with_scale(node.T_world_node);
  for (Constraint& constraint : out.constraints) {
    auto& edge = std::get<RelativePoseConstraint>(constraint);
    edge.T_from_to = with_scale(edge.T_from_to);
    Information information = Information::Zero(7, 7);
    information.topLeftCorner<6, 6>() = edge.information;
    information(6, 6) = 1 / (kScaleSigma * kScaleSigma);
    edge.information = information;
  }
  return out;
}

GeoreferenceInput read_run(const std::string& folder) {
  const auto path = [&](const char* name) { return (fs::path(folder) / name).string(); };
  GeoreferenceInput input;
  input.graph = read_g2o(path("graph.g2o"));
  input.visits = read_visits(path("places.json"));
  input.motion = read_trajectory(path("trajectory_optimized.tum"));
  take_json(path("result.json"), "run", [&](const json& result) {
    if (!metric_of(result)) input.graph = similarity_graph(input.graph);
  });
  return input;
}

GeoreferenceInput read_saved_map(const std::string& path) {
  const StoredMap stored = read_map(path);
  require(stored.origin.calibration.has_value(),
          path + ": is a map of images without a camera, in which nothing has a pose");
  const Map& map = stored.map;
  GeoreferenceInput input;
  input.graph = map.place_graph.pose_graph();
  if (!map.metric) input.graph = similarity_graph(input.graph);
  for (const Place& place : map.place_graph.places)
    for (const PlaceMember& member : place.members)
      input.visits.push_back(
          {map.find_keyframe(member.keyframe)->stamp_ns, node_of_place(place.id)});
  input.motion = map.trajectory_optimized();
  std::erase_if(input.motion.poses, [](const StampedPose& pose) { return !pose.T_world_body; });
  return input;
}

}  // namespace

GeoreferenceInput read_georeference_input(const std::string& path, const std::string& times_path) {
  if (fs::is_directory(path)) {
    require(times_path.empty(), "--times: the folder of a run has its own");
    return read_run(path);
  }
  if (fs::path(path).extension() == ".db") {
    require(times_path.empty(), "--times: a saved map has its own");
    return read_saved_map(path);
  }
  GeoreferenceInput input;
  input.graph = read_pose_graph(path);
  require(!times_path.empty(), "--times: needed with a file of a graph (line i: time of node i)");
  const std::vector<std::int64_t> stamps_ns = read_kitti_times(times_path);
  for (const PoseNode& node : input.graph.nodes) {
    if (node.id.value() < 0 || node.id.value() >= static_cast<std::int64_t>(stamps_ns.size()))
      throw FileError(times_path,
                      fmt::format("holds {} times, none for node {}", stamps_ns.size(), node.id));
    input.visits.push_back({stamps_ns[static_cast<std::size_t>(node.id.value())], node.id});
  }
  return input;
}

PoseGraph metric_graph(const PoseGraph& graph) {
  PoseGraph out;
  const auto index = graph.index_by_id();
  for (const PoseNode& node : graph.nodes)
    out.nodes.push_back(
        {node.id,
         graph.kind() == PoseKind::kSE2 ? node.T_world_node : Pose(rigid_part(node.T_world_node)),
         node.fixed});
  for (const Constraint& constraint : graph.constraints) {
    const auto* edge = std::get_if<RelativePoseConstraint>(&constraint);
    if (!edge) continue;
    out.constraints.emplace_back(*edge);
    if (graph.kind() != PoseKind::kSim3) continue;
    auto& metric = std::get<RelativePoseConstraint>(out.constraints.back());
    const double scale = scale_of(graph.nodes[index.at(edge->from)].T_world_node);
    const SE3 T = rigid_part(edge->T_from_to);
    metric.T_from_to = T.scaled(scale);
    Information information = edge->information.topLeftCorner(6, 6);
    information.topRows(3) /= scale;
    information.leftCols(3) /= scale;
    metric.information = information;
  }
  return out;
}

std::string fixes_csv(const GeoreferenceResult& result, const std::vector<GpsFix>& fixes) {
  CsvText csv;
  csv.row("stamp_ns", "node", "residual_east_m", "residual_north_m", "residual_up_m",
          "sigma_horizontal_m", "sigma_vertical_m", "weight", "rejected");
  for (std::size_t i = 0; i < fixes.size(); ++i) {
    const FixReport& fix = result.fixes[i];
    csv.add(fixes[i].stamp_ns);
    csv.add(fix.node ? fmt::format("{}", result.graph.nodes[*fix.node].id) : "");
    for (const double value : {fix.residual_enu[0], fix.residual_enu[1], fix.residual_enu[2],
                               fix.sigma_horizontal_m, fix.sigma_vertical_m, fix.weight})
      csv.add(fix.node ? fmt::format("{:.4f}", value) : "");
    csv.row(fix.node ? fmt::format("{:d}", fix.rejected) : "");
  }
  return csv.text();
}

nlohmann::ordered_json describe_georeference(const GeoreferenceResult& result) {
  const Eigen::Quaterniond& q = result.T_enu_map.rotation().quaternion();
  nlohmann::ordered_json dropouts = nlohmann::ordered_json::array();
  for (const GpsDropout& dropout : result.dropouts)
    dropouts.push_back({{"begin_s", 1e-9 * static_cast<double>(dropout.begin_ns)},
                        {"end_s", 1e-9 * static_cast<double>(dropout.end_ns)}});
  const bool estimated = !result.lever_arm_covariance.isZero();
  nlohmann::ordered_json json;
  json["origin"] = {{"latitude_deg", result.origin.latitude_deg},
                    {"longitude_deg", result.origin.longitude_deg},
                    {"height_m", result.origin.height_m}};
  json["frame"] = "east-north-up, tangent to WGS84 at the origin";
  json["T_enu_map"] = {{"scale", result.T_enu_map.scale()},
                       {"position_m", numbers(result.T_enu_map.translation())},
                       {"quaternion_xyzw", {q.x(), q.y(), q.z(), q.w()}}};
  if (const auto& scale = result.scale)
    json["scale"] = {{"metres_per_unit", scale->metres_per_unit}, {"sigma", scale->sigma}};
  json["alignment_rmse_m"] = result.alignment_rmse_m;
  json["nodes"] = result.graph.nodes.size();
  json["unplaced_nodes"] = result.unplaced_nodes;
  json["fixes"] = result.fixes.size();
  json["fixes_used"] = result.fixes_used;
  json["fixes_rejected"] = result.fixes_rejected;
  json["residual_rms_m"] = result.residual_rms_m;
  json["accuracy_factor_horizontal"] = result.accuracy_factor_horizontal;
  json["accuracy_factor_vertical"] = result.accuracy_factor_vertical;
  json["odometry_factor_translation"] = result.odometry_factor_translation;
  json["odometry_factor_rotation"] = result.odometry_factor_rotation;
  json["map_delay_s"] = result.map_delay_s;
  if (result.map_delay_sigma_s > 0) json["map_delay_sigma_s"] = result.map_delay_sigma_s;
  json["dropouts"] = dropouts;
  json["lever_arm_m"] = numbers(result.lever_arm);
  json["lever_arm_estimated"] = estimated;
  if (estimated) {
    json["lever_arm_sigma_m"] = numbers(result.lever_arm_covariance.diagonal().cwiseSqrt());
    json["lever_arm_observable"] = {result.lever_arm_observable[0], result.lever_arm_observable[1],
                                    result.lever_arm_observable[2]};
  }
  json["clock_offset_s"] = result.clock_offset_s;
  if (result.clock_offset_sigma_s > 0) json["clock_offset_sigma_s"] = result.clock_offset_sigma_s;
  json["iterations"] = result.iterations;
  return json;
}

}  // namespace placegraph::apps
