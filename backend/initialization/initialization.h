#pragma once
#include <placegraph/backend/factors/pose_error.h>
#include <placegraph/backend/solver/packed_graph.h>

namespace placegraph {

// Initializations of a pose graph from its measurements; of the poses in the graph only those of
// held nodes are used. Edges of weight zero are left out. A connected component without held nodes
// is aligned as a whole to its measured positions; without these it keeps its first pose.

/// Sets every pose by the measurements along a breadth-first spanning tree from the held nodes.
/// Edges other than odometry are used only for nodes that odometry does not reach.
template <class Group>
void spanning_tree_initialization(PackedGraph<Group>& graph);

/// The chordal initialization (Carlone et al. 2015, section IV-B; Martinec & Pajdla 2007).
/// With the weights of the isotropic problem,
///
///   1. Sim(3): log scales by linear least squares,
///   2. min sum rotation_weight |M_j - M_i R_ij|_F^2 over all matrices M_i, each then replaced by
///      the nearest rotation,
///   3. min sum translation_weight |t_j - t_i - s_i R_i t_ij|^2 over all translations, measured
///      positions included.
///
/// Exact if the measurements agree. Three linear systems with the same pattern and ordering.
template <class Group>
void chordal_initialization(PackedGraph<Group>& graph,
                            RotationError rotation_error = RotationError::kLog);

/// Aligns every component with measured positions and without held node to its positions.
/// It is moved as a whole (Sim(3): also scaled) so that sum w |T_world_node lever_arm - position|^2
/// is minimal.
template <class Group>
void align_to_positions(PackedGraph<Group>& graph);

/// Log scale of every node by linear least squares from the measured scales, with held nodes fixed.
Eigen::VectorXd log_scales(const PackedGraph<Sim3>& graph);

}  // namespace placegraph
