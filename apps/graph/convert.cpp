#include "apps/graph/convert.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/pose_graph/rigid_graph.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/graphs/g2o.h>
#include <placegraph/io/graphs/pose_graph_file.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>

#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

/// Content of a file: a g2o graph, or one of the trajectory forms.
using Form = std::optional<TrajectoryFormat>;
constexpr Form kG2o = std::nullopt;

/// Detects a pose graph by its first tag in g2o, TORO or iSAM form.
bool is_pose_graph(const std::string& path) {
  TextFile file(path);
  std::string_view line;
  if (!file.next_data(line)) return false;
  return line.starts_with("VERTEX") || line.starts_with("EDGE") || line.starts_with("ODOMETRY") ||
         line.starts_with("FIX") || line.starts_with("PARAMS_");
}

/// The form of OUT by --to, else by its extension.
Form wanted_form(const ConvertArguments& arguments) {
  static const std::map<std::string, Form> by_name = {{"kitti", TrajectoryFormat::kKitti},
                                                      {"tum", TrajectoryFormat::kTum},
                                                      {"euroc", TrajectoryFormat::kEuroc},
                                                      {"g2o", kG2o}};
  static const std::map<std::string, Form> by_extension = {{".kitti", TrajectoryFormat::kKitti},
                                                           {".txt", TrajectoryFormat::kKitti},
                                                           {".tum", TrajectoryFormat::kTum},
                                                           {".csv", TrajectoryFormat::kEuroc},
                                                           {".g2o", kG2o}};
  if (!arguments.to.empty()) {
    const auto named = by_name.find(arguments.to);
    require(named != by_name.end(),
            "--to: '" + arguments.to + "' is none of kitti, tum, euroc, g2o");
    return named->second;
  }
  const std::string extension = std::filesystem::path(arguments.out).extension().string();
  const auto found = by_extension.find(extension);
  if (found != by_extension.end()) return found->second;
  throw ArgumentError(arguments.out +
                      ": the extension is not that of a known form (.kitti .txt .tum .csv .g2o); " +
                      "name it with --to");
}

/// T_world_node without its scale; nodes of a plane have z = 0.
Eigen::Isometry3d rigid(const Pose& pose) {
  if (const SE2* planar = std::get_if<SE2>(&pose))
    return SE3(SO3::exp({0, 0, planar->rotation().angle()}),
               {planar->translation().x(), planar->translation().y(), 0})
        .isometry();
  if (const SE3* T = std::get_if<SE3>(&pose)) return T->isometry();
  const Sim3& S = std::get<Sim3>(pose);
  return SE3(S.rotation(), S.translation()).isometry();
}

/// The poses in the order of their ids.
Trajectory poses_of(PoseGraph graph) {
  std::sort(graph.nodes.begin(), graph.nodes.end(),
            [](const PoseNode& a, const PoseNode& b) { return a.id < b.id; });
  Trajectory trajectory;
  trajectory.has_times = false;
  for (const PoseNode& node : graph.nodes)
    trajectory.poses.push_back(
        {static_cast<std::int64_t>(trajectory.size()), rigid(node.T_world_node)});
  return trajectory;
}

ConvertResult convert_graph(const ConvertArguments& arguments, Form to) {
  if (!arguments.times.empty()) throw ArgumentError("--times: a pose graph has none");
  require(!arguments.posed_only && arguments.posed_in.empty(),
          "--posed-only, --posed-in: a pose graph has no lost frames");
  std::vector<std::string> remarks;
  LandmarkGraph graph =
      read_landmark_graph(arguments.in, {.connected = false, .remarks = &remarks});
  for (const std::string& remark : remarks) warn(arguments.in + ": " + remark);
  if (arguments.rigid) graph.poses = rigid_graph(graph.poses);
  ConvertResult result;
  result.nodes = graph.poses.nodes.size();
  result.landmarks = graph.points.size();
  if (to == TrajectoryFormat::kKitti) {
    result.kind = ConvertResult::Kind::kPosesOfGraph;
    write_trajectory(arguments.out, poses_of(graph.poses), *to);
    return result;
  }
  result.kind = ConvertResult::Kind::kGraph;
  result.constraints = graph.poses.constraints.size();
  result.priors = graph.priors.size();
  result.observations = graph.observations.size();
  result.poses_alone = graph.has_poses_alone();
  write_g2o(arguments.out, graph);
  return result;
}

/// Removes the frames without a pose, here or in the trajectory `posed_in` (if given) of as many
/// frames, so that both files keep one line for each remaining frame.
Trajectory posed_frames(const Trajectory& trajectory, const std::string& path,
                        const std::string& posed_in) {
  Trajectory other = trajectory;
  if (!posed_in.empty()) other = warned(read_trajectory(posed_in, ""));
  require(other.size() == trajectory.size(),
          fmt::format("--posed-in: {} has {} frames, {} has {}", posed_in, other.size(), path,
                      trajectory.size()));
  Trajectory posed = trajectory;
  posed.poses.clear();
  for (std::size_t i = 0; i < trajectory.size(); ++i)
    if (trajectory.poses[i].T_world_body && other.poses[i].T_world_body)
      posed.poses.push_back(trajectory.poses[i]);
  return posed;
}

ConvertResult convert_trajectory(const ConvertArguments& arguments, TrajectoryFormat to) {
  require(!arguments.rigid, "--rigid: " + arguments.in + " is a trajectory, not a pose graph");
  const Trajectory read = read_trajectory(arguments.in, arguments.times);
  const Trajectory trajectory = arguments.posed_only || !arguments.posed_in.empty()
                                    ? posed_frames(read, arguments.in, arguments.posed_in)
                                    : read;
  if (to != TrajectoryFormat::kKitti && !trajectory.has_times) {
    throw ArgumentError(arguments.in + ": has no times, which " + arguments.out +
                        " needs; give them with --times");
  }
  write_trajectory(arguments.out, trajectory, to);
  ConvertResult result;
  result.kind = ConvertResult::Kind::kTrajectory;
  result.frames = trajectory.size();
  result.posed = trajectory.posed();
  result.left_out = read.size() - trajectory.size();
  return result;
}

}  // namespace

ConvertResult convert(const ConvertArguments& arguments) {
  const Form to = wanted_form(arguments);
  require_free(arguments.out, arguments.force);
  const bool graph = is_pose_graph(arguments.in);
  if (!graph && to == kG2o)
    throw ArgumentError(arguments.in + ": is a trajectory, which does not become a pose graph");
  if (graph && to != kG2o && to != TrajectoryFormat::kKitti)
    throw ArgumentError(arguments.in + ": is a pose graph; its poses have no times, which " +
                        arguments.out + " needs");
  ConvertResult result = graph ? convert_graph(arguments, to) : convert_trajectory(arguments, *to);
  result.in = arguments.in;
  result.out = arguments.out;
  return result;
}

std::string to_text(const ConvertResult& result) {
  std::string found;
  switch (result.kind) {
    case ConvertResult::Kind::kTrajectory:
      found = fmt::format(
          "{} poses of {} frames{}", result.posed, result.frames,
          result.left_out > 0 ? fmt::format(" ({} frames left out)", result.left_out) : "");
      break;
    case ConvertResult::Kind::kPosesOfGraph:
      found = fmt::format(
          "{} poses in the order of their ids{}", result.nodes,
          result.landmarks > 0 ? fmt::format(" ({} landmarks left out)", result.landmarks) : "");
      break;
    case ConvertResult::Kind::kGraph:
      found = fmt::format("{} nodes, {} constraints{}", result.nodes, result.constraints,
                          result.poses_alone
                              ? ""
                              : fmt::format(", {} priors, {} landmarks seen {} times",
                                            result.priors, result.landmarks, result.observations));
      break;
  }
  return fmt::format("{}: {}, written to {}\n", result.in, found, result.out);
}

}  // namespace placegraph::apps
