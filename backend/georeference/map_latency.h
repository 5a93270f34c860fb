#pragma once
#include <placegraph/backend/georeference/antenna_trajectory.h>

#include <vector>

namespace placegraph {

/// The steps of a map's nodes that correct a latency of its poses.
/// The pose stamped t of such a map is that of time t - delay, e.g. by the latency of a filter, an
/// image stamped at readout or readings of another packet. The map deviates from correctly stamped
/// fixes wherever the vehicle accelerates or rotates.
///
/// The result has the motion T_node_later of each node within `delay_s` (which may be negative)
/// after its first visit, in the node's frame and scale; identity for nodes without a visit.
/// `motion` is T_map_body, linear between its poses if they are at most `max_gap_s` apart; beyond
/// its ends and at gaps the step before (or after) is repeated.
std::vector<SE3> steps_of_delay(const PoseGraph& map, const std::vector<NodeVisit>& visits,
                                const Trajectory& motion, double delay_s, double max_gap_s);

/// Moves every node by its step, T_world_node * step, and adapts the relative poses.
/// They become step_from^-1 * T_from_to * step_to, so that the errors stay the same.
void move_nodes(PoseGraph& graph, const std::vector<SE3>& steps);

/// The motion whose pose at every stamp t is that of `motion` at t + delay.
Trajectory without_delay(const Trajectory& motion, double delay_s, double max_gap_s);

}  // namespace placegraph
