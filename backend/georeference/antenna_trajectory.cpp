#include <placegraph/backend/georeference/antenna_trajectory.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/pose_graph/node_index.h>

#include <algorithm>

namespace placegraph {
namespace {

/// Half the time over which a velocity is computed: about a frame, which suppresses noise of the
/// motion.
constexpr std::int64_t kHalfStep_ns = 50'000'000;

/// Interpolates from a to b by `share`: translation linearly, rotation geodesically.
SE3 between(const SE3& a, const SE3& b, double share) {
  const SO3 R_a_b = a.rotation().inverse() * b.rotation();
  return SE3(a.rotation().plus(share * R_a_b.log()),
             (1 - share) * a.translation() + share * b.translation());
}

}  // namespace

AntennaTrack::AntennaTrack(const PoseGraph& graph, std::vector<NodeVisit> visits, Trajectory motion)
    : motion_(std::move(motion)) {
  require(!visits.empty(), "georeference: no node has a time");
  std::sort(visits.begin(), visits.end(),
            [](const NodeVisit& a, const NodeVisit& b) { return a.stamp_ns < b.stamp_ns; });
  for (const PoseNode& node : graph.nodes) {
    T_map_node_.push_back(rigid_part(node.T_world_node));
    scale_.push_back(scale_of(node.T_world_node));
  }
  const auto index = graph.index_by_id();
  for (const NodeVisit& visit : visits) {
    const std::optional<int> node = index.find(visit.node);
    require(node.has_value(), "georeference: a time of node " + to_string(visit.node) +
                                  ", which is not in the graph");
    require(visits_.empty() || visits_.back().stamp_ns < visit.stamp_ns,
            "georeference: two nodes have the time " + std::to_string(visit.stamp_ns) + " ns");
    visits_.push_back({visit.stamp_ns, *node});
  }
  if (motion_.poses.empty())
    for (const Visit& visit : visits_)
      motion_.poses.push_back({visit.stamp_ns, T_map_node_[visit.node].isometry()});
}

/// Positions in visits_ of the last visit not after `stamp_ns` and the first one after it; both are
/// the same outside of the visits.
std::pair<int, int> AntennaTrack::neighbours(std::int64_t stamp_ns) const {
  const auto after =
      std::upper_bound(visits_.begin(), visits_.end(), stamp_ns,
                       [](std::int64_t stamp, const Visit& v) { return stamp < v.stamp_ns; });
  const int next = static_cast<int>(after - visits_.begin());
  const int last = static_cast<int>(visits_.size()) - 1;
  return {std::max(next - 1, 0), std::min(next, last)};
}

std::vector<std::optional<InterpolatedFix>> AntennaTrack::interpolate_fixes(
    const std::vector<std::int64_t>& stamps_ns, const Eigen::Vector3d& lever_arm,
    double max_gap_s) const {
  std::vector<std::optional<InterpolatedFix>> interpolated(stamps_ns.size());
  for (std::size_t i = 0; i < stamps_ns.size(); ++i) {
    const std::int64_t stamp = stamps_ns[i];
    const std::optional<SE3> T_map_body = interpolate(motion_, stamp, max_gap_s);
    if (!T_map_body) continue;
    const auto [before, after] = neighbours(stamp);
    const bool first = stamp - visits_[before].stamp_ns <= visits_[after].stamp_ns - stamp;
    InterpolatedFix fix;
    fix.node = visits_[first ? before : after].node;
    const SE3 T_node_map = T_map_node_[fix.node].inverse();
    const SE3 T_node_body = T_node_map * *T_map_body;
    const double unit = 1 / scale_[fix.node];
    fix.A = T_node_body.rotation().matrix();
    fix.t = unit * T_node_body.translation();
    const auto earlier = interpolate(motion_, stamp - kHalfStep_ns, max_gap_s);
    const auto later = interpolate(motion_, stamp + kHalfStep_ns, max_gap_s);
    if (earlier || later) {
      const SE3 a = earlier.value_or(*T_map_body), b = later.value_or(*T_map_body);
      const double seconds = 1e-9 * static_cast<double>(kHalfStep_ns) * (earlier && later ? 2 : 1);
      fix.v = (unit / seconds) * (T_node_map * (b * lever_arm) - T_node_map * (a * lever_arm));
    }
    interpolated[i] = fix;
  }
  return interpolated;
}

Trajectory AntennaTrack::moved(const PoseGraph& optimized) const {
  Trajectory out = motion_;
  for (StampedPose& pose : out.poses) {
    if (!pose.T_world_body) continue;
    const SE3 T_map_body(*pose.T_world_body);
    const auto follow = [&](int node) {
      const Pose& moved = optimized.nodes[node].T_world_node;
      const SE3 T_node_body = T_map_node_[node].inverse() * T_map_body;
      const double stretch = scale_of(moved) / scale_[node];
      return rigid_part(moved) * T_node_body.scaled(stretch);
    };
    const auto [before, after] = neighbours(pose.stamp_ns);
    SE3 T = follow(visits_[before].node);
    if (after != before) {
      const double gap = static_cast<double>(visits_[after].stamp_ns - visits_[before].stamp_ns);
      const double share = static_cast<double>(pose.stamp_ns - visits_[before].stamp_ns) / gap;
      T = between(T, follow(visits_[after].node), std::clamp(share, 0.0, 1.0));
    }
    pose.T_world_body = T.isometry();
  }
  return out;
}

}  // namespace placegraph
