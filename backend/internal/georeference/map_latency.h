#pragma once
#include <placegraph/backend/internal/georeference/antenna_trajectory.h>

#include <vector>

namespace placegraph {

/// A map whose poses lag behind their stamps: what is said of the time t was so at t - delay. (A
/// filter's latency, an image stamped when it was read out, readings of another packet.) It lies
/// crooked to fixes that hold at their stamps wherever the vehicle speeds up or turns.
///
/// The step T_node_later that takes each node on by `delay_s` (which may be negative) from its
/// first visit, in the node's frame and unit; identity for nodes without a visit. `motion` is
/// T_map_body, linear between its poses where they are at most `max_gap_s` apart; beyond its ends
/// and at gaps the step before (or after) is repeated.
std::vector<SE3> steps_of_delay(const PoseGraph& map, const std::vector<NodeVisit>& visits,
                                const Trajectory& motion, double delay_s, double max_gap_s);

/// Every node a step further, T_world_node * step, and every relative pose between the nodes'
/// new places, step_from^-1 * T_from_to * step_to: the errors stay what they are.
void move_nodes(PoseGraph& graph, const std::vector<SE3>& steps);

/// The motion that says of every stamp t what `motion` says of t + delay.
Trajectory without_delay(const Trajectory& motion, double delay_s, double max_gap_s);

}  // namespace placegraph
