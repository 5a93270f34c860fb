#pragma once
#include <placegraph/backend/georeference/georeference_report.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/geometry/trajectory.h>
#include <placegraph/graph/pose_graph/pose_graph.h>
#include <placegraph/graph/pose_graph/rigid_graph.h>

#include <optional>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A fix relative to a node.
/// The antenna at the time of the fix, in the node's frame and scale,
///
///   p_node = A lever_arm + t + v clock_offset,
///
/// with [A | t] the motion from the node to the vehicle at that time. So a fix need not coincide
/// with a node, and every fix is used once, without interpolation between fixes.
struct InterpolatedFix {
  int node = 0;  ///< position in PoseGraph::nodes
  Eigen::Matrix3d A = Eigen::Matrix3d::Identity();
  Eigen::Vector3d t = Eigen::Vector3d::Zero();
  Eigen::Vector3d v = Eigen::Vector3d::Zero();  ///< velocity of the antenna, per second

  Eigen::Vector3d antenna(const Eigen::Vector3d& lever_arm, double clock_offset_s) const {
    return A * lever_arm + t + v * clock_offset_s;
  }
};

/// The vehicle's motion relative to the nodes of a graph.
class AntennaTrack {
 public:
  /// `motion` is in the frame of the poses of `graph`; if it is empty, the nodes at the times of
  /// their visits replace it. Throws ArgumentError: a visit to an unknown node, two visits at one
  /// time, no visits.
  AntennaTrack(const PoseGraph& graph, std::vector<NodeVisit> visits, Trajectory motion);

  /// Transfers fixes taken at `stamps_ns` to the nodes visited nearest in time.
  /// Between neighbours of the motion at most `max_gap_s` apart the translation is interpolated
  /// linearly and the rotation geodesically. Empty for a fix outside of the motion or in a longer
  /// gap. `lever_arm` is used for the velocity.
  std::vector<std::optional<InterpolatedFix>> interpolate_fixes(
      const std::vector<std::int64_t>& stamps_ns, const Eigen::Vector3d& lever_arm,
      double max_gap_s) const;

  /// T_map_body; the nodes at the times of their visits if no motion was given.
  const Trajectory& motion() const { return motion_; }

  /// The motion after the nodes, which are the same, have moved to the poses of `optimized`.
  /// Each pose moves with the node visited before and the node visited after it, weighted by their
  /// distance in time.
  Trajectory moved(const PoseGraph& optimized) const;

 private:
  struct Visit {
    std::int64_t stamp_ns;
    int node;  ///< position of the node in the graph
  };
  std::pair<int, int> neighbours(std::int64_t stamp_ns) const;

  std::vector<SE3> T_map_node_;
  std::vector<double> scale_;  ///< scale of each node relative to the map
  std::vector<Visit> visits_;  ///< visits in time order
  Trajectory motion_;          ///< T_map_body
};

}  // namespace placegraph
