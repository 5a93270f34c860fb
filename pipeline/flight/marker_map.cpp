#include <placegraph/backend/pose_graph/pose_graph_optimizer.h>
#include <placegraph/backend/solver/pose_marginals.h>
#include <placegraph/frontend/markers/marker_pose.h>
#include <placegraph/graph/core/chi_squared.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/flight/marker_map.h>

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

/// Squared deviation of one view's pose from where the marker is taken to be, odometry believed.
double deviation2(const MarkerFrame& frame, const MarkerPose& pose, const SE3& T_odom_marker) {
  const Vector6d d =
      (pose.T_cam_marker.inverse() * frame.T_odom_cam.inverse() * T_odom_marker).log();
  return d.dot(pose.covariance.ldlt().solve(d));
}

/// Where the marker is: the pose of one view that most others agree with, each by its better pose.
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

/// Of every view the pose near the consensus.
std::vector<Chosen> choose(const std::vector<MarkerFrame>& frames, const std::vector<View>& views,
                           const SE3& T_odom_marker) {
  std::vector<Chosen> chosen;
  for (const View& view : views) {
    const auto nearer = std::min_element(view.poses.begin(), view.poses.end(),
                                         [&](const MarkerPose& a, const MarkerPose& b) {
                                           return deviation2(frames[view.frame], a, T_odom_marker) <
                                                  deviation2(frames[view.frame], b, T_odom_marker);
                                         });
    // Mirrored poses are far apart where they matter: odometry may drift without changing which.
    const SE3 off =
        nearer->T_cam_marker.inverse() * frames[view.frame].T_odom_cam.inverse() * T_odom_marker;
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
    graph.nodes.push_back(
        {static_cast<std::int64_t>(i), Pose(T_world_odom * frames[i].T_odom_cam), false});
    if (i == 0) continue;
    RelativePoseConstraint step;
    step.from = static_cast<std::int64_t>(i) - 1;
    step.to = static_cast<std::int64_t>(i);
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

}  // namespace

void MarkerMapOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, MarkerMapOptions& o) {
  field("gate", o.gate, "of a sighting against what the others say of its marker", {0.5, 0.999999});
  field("extra_sigma_px", o.extra_sigma_px, "of a corner, beside its own", {0, 10});
  field("min_views", o.min_views, "of a marker that is mapped", {1, 1e6});
}

std::int64_t marker_node(int id) {
  constexpr std::int64_t kFirst = 1'000'000'000;
  return kFirst + id;
}

MarkerLayout MarkerMap::layout(const std::string& dictionary) const {
  MarkerLayout result;
  result.dictionary = dictionary;
  for (const MappedMarker& mapped : markers) result.markers.push_back(mapped.marker);
  return result;
}

MarkerMap map_markers(const std::vector<MarkerFrame>& frames, const MarkerLayout& known,
                      const std::map<int, double>& sides_m, const Camera& camera,
                      const MarkerMapOptions& options) {
  options.check();
  MarkerMap map;
  std::map<int, std::vector<View>> views;
  std::map<int, double> sides;
  for (std::size_t i = 0; i < frames.size(); ++i)
    for (MarkerSighting sighting : frames[i].markers) {
      const PlacedMarker* placed = find(known, sighting.id);
      const auto side = sides_m.find(sighting.id);
      if (!placed && side == sides_m.end()) continue;
      sides[sighting.id] = placed ? placed->side_m : side->second;
      sighting.covariance.diagonal().array() += options.extra_sigma_px * options.extra_sigma_px;
      MarkerPoses poses = estimate_marker_poses(sighting, sides[sighting.id], camera);
      if (poses.outcome)
        views[sighting.id].push_back({static_cast<int>(i), std::move(poses.poses)});
    }

  const double gate = chi_squared_quantile(options.gate, 6);
  std::map<int, SE3> T_odom_marker;
  std::map<int, std::vector<Chosen>> chosen;
  for (const auto& [id, seen] : views) {
    const auto at = consensus(frames, seen, gate);
    if (!at) continue;
    std::vector<Chosen> kept = choose(frames, seen, *at);
    if (static_cast<int>(kept.size()) < options.min_views) continue;
    T_odom_marker[id] = *at;
    chosen[id] = std::move(kept);
  }
  if (chosen.empty()) {
    map.outcome = Outcome::failure(
        Code::kTooFewData, "no marker is seen in " + std::to_string(options.min_views) + " frames");
    return map;
  }
  SE3 T_world_odom;
  for (const auto& [id, at] : T_odom_marker)
    if (const PlacedMarker* placed = find(known, id)) {
      T_world_odom = placed->T_world_marker * at.inverse();
      break;
    }
  add_frames(frames, T_world_odom, map.graph);
  for (const auto& [id, kept] : chosen) {
    const PlacedMarker* placed = find(known, id);
    map.graph.nodes.push_back(
        {marker_node(id), Pose(placed ? placed->T_world_marker : T_world_odom * T_odom_marker[id]),
         placed != nullptr});
    for (const Chosen& view : kept) {
      RelativePoseConstraint seen;
      seen.from = view.frame;
      seen.to = marker_node(id);
      seen.T_from_to = Pose(view.pose.T_cam_marker);
      seen.information = inverse(view.pose.covariance);
      seen.source = ConstraintSource::kOther;
      map.graph.constraints.emplace_back(seen);
    }
  }
  // The start is good, and a held marker far down the list must not be outweighed by another one.
  PoseGraphOptions solver;
  solver.start = PoseGraphStart::kFile;
  const PoseGraphReport solved = optimize_pose_graph(std::move(map.graph), solver);
  map.graph = solved.graph;
  map.outcome = solved.outcome;
  if (!map.outcome) return map;
  const PoseMarginals marginals(map.graph);
  if (!marginals.outcome()) {
    map.outcome = marginals.outcome();
    return map;
  }
  const NodeIndex index = map.graph.index_by_id();
  for (const auto& [id, kept] : chosen) {
    MappedMarker mapped;
    const PoseNode& node = map.graph.nodes[static_cast<std::size_t>(index.at(marker_node(id)))];
    mapped.marker = {id, sides[id], std::get<SE3>(node.T_world_node)};
    mapped.views = static_cast<int>(kept.size());
    if (!node.fixed) mapped.covariance = marginals.covariance(node.id);
    map.markers.push_back(mapped);
  }
  return map;
}

}  // namespace placegraph
