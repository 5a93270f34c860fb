#include "apps/graph/convert.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/geometry/trajectory_edit.h>
#include <placegraph/graph/pose_graph/rigid_graph.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/graphs/g2o.h>
#include <placegraph/io/graphs/pose_graph_file.h>
#include <placegraph/io/trajectories/trajectory_file.h>
#include <placegraph/io/trajectories/trajectory_filter.h>

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
  require(arguments.merge.empty() && arguments.apply.empty() && arguments.split.empty(),
          "--merge, --apply, --split: these are for trajectories, not for a pose graph");
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

/// A trajectory, with those that are joined to it.
struct JoinedTrajectory {
  Trajectory trajectory;
  std::size_t frames = 0;  ///< that were read
};

JoinedTrajectory read_joined(const ConvertArguments& arguments) {
  Trajectory first = warned(read_trajectory(arguments.in, arguments.times));
  std::size_t frames = first.size();
  if (arguments.merge.empty()) return {std::move(first), frames};
  require(first.has_times, "--merge: " + arguments.in + " has no times; give them with --times");
  std::vector<Trajectory> parts = {std::move(first)};
  for (const std::string& path : arguments.merge) {
    parts.push_back(warned(read_timed_poses(path)));
    frames += parts.back().size();
  }
  try {
    return {merge(std::move(parts), arguments.overlap ? Overlap::kFirstKept : Overlap::kRefused)
                .trajectory,
            frames};
  } catch (const ArgumentError& error) {
    throw ArgumentError(std::string("--merge: ") + error.what() +
                        "; --overlap keeps what begins first");
  }
}

std::vector<Trajectory> parts_of(const Trajectory& trajectory, const std::string& split) {
  if (split.empty()) return {trajectory};
  if (split == "gaps")
    return split_at_gaps(trajectory, 1e-9 * static_cast<double>(longest_spacing_ns(trajectory)));
  const auto length_s = split.ends_with('s') ? parse_double(split.substr(0, split.size() - 1))
                                             : std::nullopt;
  require(length_s && *length_s > 0,
          "--split: '" + split + "' is neither gaps nor a length of time, as 60s");
  return split_every(trajectory, *length_s);
}

/// "out.tum" of 12 parts: "out_01.tum", "out_02.tum", ...
std::vector<std::string> part_paths(const std::filesystem::path& out, std::size_t parts) {
  std::vector<std::string> paths;
  const int digits = static_cast<int>(std::to_string(parts).size());
  for (std::size_t i = 1; i <= parts; ++i)
    paths.push_back((out.parent_path() / fmt::format("{}_{:0{}}{}", out.stem().string(), i, digits,
                                                     out.extension().string()))
                        .string());
  return paths;
}

/// Writes all parts, or removes those that are written.
void write_parts(const std::vector<std::string>& paths, const std::vector<Trajectory>& parts,
                 TrajectoryFormat to) {
  std::size_t written = 0;
  try {
    for (; written < paths.size(); ++written) write_trajectory(paths[written], parts[written], to);
  } catch (const Error&) {
    std::error_code ignored;
    for (std::size_t i = 0; i < written; ++i) std::filesystem::remove(paths[i], ignored);
    throw;
  }
}

ConvertResult convert_trajectory(const ConvertArguments& arguments, TrajectoryFormat to) {
  require(!arguments.rigid, "--rigid: " + arguments.in + " is a trajectory, not a pose graph");
  const TrajectoryFilter filter(arguments.apply);
  const JoinedTrajectory read = read_joined(arguments);
  const Trajectory trajectory =
      filter.apply(arguments.posed_only || !arguments.posed_in.empty()
                       ? posed_frames(read.trajectory, arguments.in, arguments.posed_in)
                       : read.trajectory);
  if (to != TrajectoryFormat::kKitti && !trajectory.has_times) {
    throw ArgumentError(arguments.in + ": has no times, which " + arguments.out +
                        " needs; give them with --times");
  }
  ConvertResult result;
  const std::vector<Trajectory> parts = parts_of(trajectory, arguments.split);
  if (!arguments.split.empty()) result.parts = part_paths(arguments.out, parts.size());
  for (const std::string& path : result.parts) require_free(path, arguments.force);
  write_parts(arguments.split.empty() ? std::vector{arguments.out} : result.parts, parts, to);
  result.kind = ConvertResult::Kind::kTrajectory;
  for (const Trajectory& part : parts) {
    result.frames += part.size();
    result.posed += part.posed();
  }
  result.left_out = read.frames - std::min(read.frames, result.frames);
  return result;
}

}  // namespace

ConvertResult convert(const ConvertArguments& arguments) {
  const Form to = wanted_form(arguments);
  if (arguments.split.empty()) require_free(arguments.out, arguments.force);
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
  const std::string where =
      result.parts.empty()
          ? result.out
          : fmt::format("{} files, {} to {}", result.parts.size(), result.parts.front(),
                        result.parts.back());
  return fmt::format("{}: {}, written to {}\n", result.in, found, where);
}

}  // namespace placegraph::apps
