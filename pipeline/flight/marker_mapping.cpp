#include <placegraph/backend/pose_graph/pose_graph_optimizer.h>
#include <placegraph/backend/pose_graph/pose_marginals.h>
#include <placegraph/frontend/markers/marker_pose.h>
#include <placegraph/graph/core/chi_squared.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/pose_graph/node_index.h>
#include <placegraph/pipeline/flight/marker_mapping.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>
#include <optional>

namespace placegraph {
namespace {

using Code = Outcome::Code;

/// A marker in a frame: its one or two poses.
struct View {
  int frame = 0;
  std::vector<MarkerPose> poses;
};

struct Chosen {
  int frame = 0;
  MarkerPose pose;
};

/// A marker that frames show.
struct SeenMarker {
  double side_m = 0;
  const PlacedMarker* placed = nullptr;  ///< the marker in the known layout; null: to be mapped
  std::vector<View> views;
  SE3 T_odom_marker;           ///< set by `located`
  std::vector<Chosen> chosen;  ///< set by `located`: the agreeing pose of each agreeing view
};
using SeenMarkers = std::map<int, SeenMarker>;  // by id

/// Squared distance, in standard deviations, of one view's pose from the assumed pose of the
/// marker, with odometry assumed to be correct.
double deviation2(const MarkerFrame& frame, const MarkerPose& pose, const SE3& T_odom_marker) {
  const Vector6d d =
      (pose.T_cam_marker.inverse() * frame.T_odom_cam.inverse() * T_odom_marker).log();
  return d.dot(pose.covariance.ldlt().solve(d));
}

/// Pose of the marker: the pose of one view with which most others agree, each by its better pose.
std::optional<SE3> consensus(const std::vector<MarkerFrame>& frames, const std::vector<View>& views,
                             double gate) {
  std::optional<SE3> best;
  double least = std::numeric_limits<double>::infinity();
  for (const View& candidate : views)
    for (const MarkerPose& pose : candidate.poses) {
      const SE3 T_odom_marker = frames[candidate.frame].T_odom_cam * pose.T_cam_marker;
      double cost = 0;
      for (const View& view : views) {
        double nearest = gate;
        for (const MarkerPose& other : view.poses)
          nearest = std::min(nearest, deviation2(frames[view.frame], other, T_odom_marker));
        cost += nearest;
      }
      if (cost >= least) continue;
      least = cost;
      best = T_odom_marker;
    }
  return best;
}

/// The pose near the consensus, for every view.
std::vector<Chosen> choose(const std::vector<MarkerFrame>& frames, const std::vector<View>& views,
                           const SE3& T_odom_marker) {
  std::vector<Chosen> chosen;
  for (const View& view : views) {
    const auto nearer = std::min_element(view.poses.begin(), view.poses.end(),
                                         [&](const MarkerPose& a, const MarkerPose& b) {
                                           return deviation2(frames[view.frame], a, T_odom_marker) <
                                                  deviation2(frames[view.frame], b, T_odom_marker);
                                         });
    // Mirrored poses are far apart where the choice matters: odometry drift does not change it.
    const SE3 off =
        nearer->T_cam_marker.inverse() * frames[view.frame].T_odom_cam.inverse() * T_odom_marker;
    // 20 degrees. Chosen between drift and the distance of mirrored poses.
    constexpr double kMisled_rad = 0.35;
    if (off.rotation().log().norm() < kMisled_rad) chosen.push_back({view.frame, *nearer});
  }
  return chosen;
}

Matrix6d inverse(const Matrix6d& covariance) {
  const Matrix6d information = covariance.ldlt().solve(Matrix6d::Identity());
  return 0.5 * (information + information.transpose());
}

void add_frames(const std::vector<MarkerFrame>& frames, const SE3& T_world_odom, PoseGraph& graph) {
  for (std::size_t i = 0; i < frames.size(); ++i) {
    graph.nodes.push_back({NodeId(i), Pose(T_world_odom * frames[i].T_odom_cam), false});
    if (i == 0) continue;
    RelativePoseConstraint step;
    step.from = NodeId(i - 1);
    step.to = NodeId(i);
    step.T_from_to = Pose(frames[i - 1].T_odom_cam.inverse() * frames[i].T_odom_cam);
    step.information = inverse(frames[i].step_covariance);
    graph.constraints.emplace_back(step);
  }
}

const PlacedMarker* find(const MarkerLayout& known, int id) {
  for (const PlacedMarker& marker : known.markers)
    if (marker.id == id) return &marker;
  return nullptr;
}

/// The markers of `known` and of `sides_m` in all frames, each with its possible poses.
SeenMarkers collect_views(const std::vector<MarkerFrame>& frames, const MarkerLayout& known,
                          const std::map<int, double>& sides_m, const Camera& camera,
                          double extra_sigma_px) {
  SeenMarkers markers;
  for (std::size_t i = 0; i < frames.size(); ++i)
    for (MarkerObservation observation : frames[i].markers) {
      const PlacedMarker* placed = find(known, observation.id);
      const auto side = sides_m.find(observation.id);
      if (!placed && side == sides_m.end()) continue;
      SeenMarker& marker = markers[observation.id];
      marker.placed = placed;
      marker.side_m = placed ? placed->side_m : side->second;
      observation.covariance.diagonal().array() += extra_sigma_px * extra_sigma_px;
      MarkerPoses found = estimate_marker_poses(observation, marker.side_m, camera);
      if (found.outcome) marker.views.push_back({static_cast<int>(i), std::move(found.poses)});
    }
  return markers;
}

/// The markers on which enough views agree, in the odometry's world frame.
SeenMarkers located(const std::vector<MarkerFrame>& frames, const MarkerMapOptions& options,
                    const SeenMarkers& seen) {
  const double gate = chi_squared_quantile(options.gate, 6);
  SeenMarkers result;
  for (const auto& [id, marker] : seen) {
    const auto T_odom_marker = consensus(frames, marker.views, gate);
    if (!T_odom_marker) continue;
    std::vector<Chosen> chosen = choose(frames, marker.views, *T_odom_marker);
    if (static_cast<int>(chosen.size()) < options.min_views) continue;
    SeenMarker& kept = result[id] = marker;
    kept.T_odom_marker = *T_odom_marker;
    kept.chosen = std::move(chosen);
  }
  return result;
}

/// From the first marker of known pose; identity if there is none.
SE3 world_of_odometry(const SeenMarkers& markers) {
  for (const auto& [id, marker] : markers)
    if (marker.placed) return marker.placed->T_world_marker * marker.T_odom_marker.inverse();
  return {};
}

void add_markers(const SeenMarkers& markers, const SE3& T_world_odom, PoseGraph& graph) {
  for (const auto& [id, marker] : markers) {
    const SE3 T_world_marker =
        marker.placed ? marker.placed->T_world_marker : T_world_odom * marker.T_odom_marker;
    graph.nodes.push_back({marker_node(id), Pose(T_world_marker), marker.placed != nullptr});
    for (const Chosen& view : marker.chosen) {
      RelativePoseConstraint seen;
      seen.from = NodeId(view.frame);
      seen.to = marker_node(id);
      seen.T_from_to = Pose(view.pose.T_cam_marker);
      seen.information = inverse(view.pose.covariance);
      seen.source = ConstraintSource::kOther;
      graph.constraints.emplace_back(seen);
    }
  }
}

/// The markers of an optimized graph, with their covariances.
std::vector<MappedMarker> read_markers(const PoseGraph& graph, const PoseMarginals& marginals,
                                       const SeenMarkers& markers) {
  std::vector<MappedMarker> mapped;
  const NodeIndex index = graph.index_by_id();
  for (const auto& [id, marker] : markers) {
    const PoseNode& node = graph.nodes[static_cast<std::size_t>(index.at(marker_node(id)))];
    MappedMarker result;
    result.marker = {id, marker.side_m, std::get<SE3>(node.T_world_node)};
    result.views = static_cast<int>(marker.chosen.size());
    if (!node.fixed) result.covariance = marginals.covariance(node.id);
    mapped.push_back(result);
  }
  return mapped;
}

}  // namespace

MarkerMap map_markers(const std::vector<MarkerFrame>& frames, const MarkerLayout& known,
                      const std::map<int, double>& sides_m, const Camera& camera,
                      const MarkerMapOptions& options) {
  options.check();
  const SeenMarkers markers = located(
      frames, options, collect_views(frames, known, sides_m, camera, options.extra_sigma_px));
  MarkerMap map;
  if (markers.empty()) {
    map.outcome = Outcome::failure(
        Code::kTooFewData, "no marker is seen in " + std::to_string(options.min_views) + " frames");
    return map;
  }
  const SE3 T_world_odom = world_of_odometry(markers);
  add_frames(frames, T_world_odom, map.graph);
  add_markers(markers, T_world_odom, map.graph);
  // The initialization is accurate, and a fixed marker late in the list must not be outweighed by
  // another one.
  PoseGraphOptions solver;
  solver.initialization = PoseGraphInitialization::kFile;
  const PoseGraphReport solved = optimize_pose_graph(std::move(map.graph), solver);
  map.graph = solved.graph;
  map.outcome = solved.outcome;
  if (!map.outcome) return map;
  const PoseMarginals marginals(map.graph);
  map.outcome = marginals.outcome();
  if (map.outcome) map.markers = read_markers(map.graph, marginals, markers);
  return map;
}

}  // namespace placegraph
