#include "apps/eval/eval_edges.h"

#include <fmt/format.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/pose_graph/constraint_source.h>
#include <placegraph/graph/text/json_text.h>
#include <placegraph/pipeline/results/run_map.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/eval/eval_noise.h"
#include "apps/support/numbers_json.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

using nlohmann::json;

/// True pose of the camera at each place's anchor frame, by node of the graph. `file`: the truth's.
TrueNodes true_places(const Trajectory& truth, const std::string& file, const RunMap& map) {
  TrueNodes result;
  require(!map.frames || *map.frames == truth.size(),
          fmt::format("{} has {} poses, and {} is of a run of {} frames; the truth needs one pose "
                      "a frame",
                      file, truth.size(), map.file, map.frames.value_or(0)));
  for (const Place& place : map.graph.places) {
    const FrameId frame = map.anchor_frame(place);
    if (frame.value() < 0)
      throw FileError(map.file, fmt::format("place {} was seen in frame {}", to_string(place.id),
                                            to_string(frame)));
    require(frame.value() < static_cast<std::int64_t>(truth.size()),
            fmt::format("{}: place {} was seen in frame {}, and {} has {} poses", map.file,
                        to_string(place.id), to_string(frame), file, truth.size()));
    const NodeId node = node_of_place(place.id);
    result.frames[node] = static_cast<int>(frame.value());
    if (const auto& pose = truth.poses[static_cast<std::size_t>(frame.value())].T_world_body)
      result.T_world_node.emplace(node, SE3(*pose));
  }
  return result;
}

std::string table_of(const EvalEdgesResult& result) {
  std::string text =
      "source      edges  unknown  interpolated  mean NEES  median  beyond 99 %  with truth's "
      "noise  "
      "truth's share\n";
  for (const auto& [source, c] : result.by_source)
    text += fmt::format(
        "{:<10} {:>6} {:>8} {:>13} {:>10.3f} {:>7.3f} {:>10.1f} % {:>19.3f} {:>12.0f} %\n",
        to_string(source), c.edges, c.unknown, c.interpolated, c.by_stated.mean, c.by_stated.median,
        100 * c.by_stated.share_beyond_99, c.with_truth.mean, 100 * c.truth_share);
  return text;
}

std::string axes_table_of(const EvalEdgesResult& result) {
  std::string text =
      "\nsource      root mean square of    error     stated      truth  error / deviation\n";
  for (const auto& [source, c] : result.by_source)
    for (const AxisConsistency& axis : c.axes)
      text +=
          fmt::format("{:<11} {:<20} {:>9.6f}  {:>9.6f}  {:>9.6f} {:>18.2f}\n", to_string(source),
                      axis.name, axis.error, axis.stated, axis.of_truth, axis.normalized);
  return text;
}

Eigen::Vector3d degrees(const Eigen::Vector3d& angles) { return angles * (1 / kRadPerDeg); }

std::string mount_text(const TruthMount& mount) {
  const Eigen::Vector3d t = mount.T_truth_cam.translation(), t_sigma = mount.sigma.head<3>(),
                        r = degrees(mount.T_truth_cam.rotation().log()),
                        r_sigma = degrees(mount.sigma.tail<3>());
  return fmt::format(
      "Camera in the frame of the truth: turned by {:.2f} {:.2f} {:.2f} deg (standard deviations "
      "{:.2f} {:.2f} {:.2f}), at {:.3f} {:.3f} {:.3f} m ({:.3f} {:.3f} {:.3f}).\n",
      r.x(), r.y(), r.z(), r_sigma.x(), r_sigma.y(), r_sigma.z(), t.x(), t.y(), t.z(), t_sigma.x(),
      t_sigma.y(), t_sigma.z());
}

json json_of(const TruthMount& mount) {
  return {{"position_m", numbers(mount.T_truth_cam.translation())},
          {"rotation_deg", numbers(degrees(mount.T_truth_cam.rotation().log()))},
          {"sigma_m", numbers(mount.sigma.head<3>())},
          {"sigma_deg", numbers(degrees(mount.sigma.tail<3>()))}};
}

json json_of(const Nees& nees, int degrees_of_freedom) {
  const auto [low, high] = nees_interval(nees, degrees_of_freedom);
  return {{"mean_nees", nees.mean},
          {"interval_95", {low, high}},
          {"median_nees", nees.median},
          {"share_beyond_99", nees.share_beyond_99}};
}

json json_of(ConstraintSource source, const EdgeConsistency& c) {
  json report = json_of(c.by_stated, c.degrees_of_freedom);
  report["edges"] = c.edges;
  report["unknown"] = c.unknown;
  report["interpolated"] = c.interpolated;
  report["degrees_of_freedom"] = c.degrees_of_freedom;
  report["with_truth"] = json_of(c.with_truth, c.degrees_of_freedom);
  report["truth_share"] = c.truth_share;
  report["verdict"] = to_string(verdict_on(c));
  report["sentence"] = sentence_of(source, c);
  report["axes"] = json::array();
  for (const AxisConsistency& axis : c.axes)
    report["axes"].push_back({{"name", axis.name},
                              {"error", axis.error},
                              {"stated", axis.stated},
                              {"of_truth", axis.of_truth},
                              {"normalized", axis.normalized}});
  return report;
}

}  // namespace

EvalEdgesResult eval_edges(const EvalEdgesArguments& arguments) {
  const RunMap map = read_run_map(arguments.run);
  const Trajectory truth = read_true_poses(arguments.truth);
  TrueNodes nodes = true_places(truth, arguments.truth, map);
  nodes.noise = truth_noise_of(arguments.truth_noise, truth);
  EvalEdgesResult result;
  if (arguments.fit_mount) {
    result.mount = fit_mount(map.graph.constraints, nodes);
    nodes = mounted(nodes, *result.mount);
  }
  result.by_source = edge_consistency(map.graph.constraints, nodes);
  if (result.by_source.empty()) throw NoResult(map.file + ": has no edges between places");
  for (const auto& [source, c] : result.by_source)
    if (!std::isfinite(c.by_stated.mean) || !std::isfinite(c.with_truth.mean))
      throw NoResult(fmt::format("{}: the errors of the {} edges are too large to be computed",
                                 arguments.truth, to_string(source)));
  return result;
}

std::string to_text(const EvalEdgesResult& result, bool axes) {
  std::string text = table_of(result);
  if (axes) text += axes_table_of(result);
  text += "\n";
  if (result.mount) text += mount_text(*result.mount);
  for (auto it = result.by_source.rbegin(); it != result.by_source.rend(); ++it)
    text += sentence_of(it->first, it->second) + "\n";
  return text;
}

std::string to_json(const EvalEdgesResult& result) {
  json report = json::object();
  for (const auto& [source, c] : result.by_source) report[to_string(source)] = json_of(source, c);
  if (result.mount) report["mount"] = json_of(*result.mount);
  return json_text(report, 1);
}

}  // namespace placegraph::apps
