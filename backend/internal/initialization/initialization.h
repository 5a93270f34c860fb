#pragma once
#include <placegraph/backend/factors/pose_error.h>
#include <placegraph/backend/internal/solver/packed_graph.h>

namespace placegraph {

// Starts of a pose graph from its measurements alone; the poses in the graph are looked at only
// where a node is held. Edges of weight zero are left out. A connected component that no held node
// but only measured positions tie to the world is laid over them as a whole; one that nothing ties
// keeps its first pose.

/// Every pose by the measurements along a breadth-first spanning tree from the held nodes; other
/// edges than odometry are used only where odometry leads no further.
template <class Group>
void spanning_tree_initialization(PackedGraph<Group>& graph);

/// The chordal start (Carlone et al. 2015, section IV-B; Martinec & Pajdla 2007): with the weights
/// of the isotropic problem,
///
///   1. Sim(3): log scales by linear least squares,
///   2. min sum rotation_weight |M_j - M_i R_ij|_F^2 over all matrices M_i, each then replaced by
///      the nearest rotation,
///   3. min sum translation_weight |t_j - t_i - s_i R_i t_ij|^2 over all translations, measured
///      positions included.
///
/// Exact where the measurements agree. Three linear systems of one pattern and one ordering.
template <class Group>
void chordal_initialization(PackedGraph<Group>& graph,
                            RotationError rotation_error = RotationError::kLog);

/// Moves every component that has measured positions and no held node as a whole (Sim(3): scaled
/// too) so that sum w |T_world_node lever_arm - position|^2 becomes least.
template <class Group>
void align_to_positions(PackedGraph<Group>& graph);

/// Log scale of every node by linear least squares from the measured ones, held nodes kept.
Eigen::VectorXd log_scales(const PackedGraph<Sim3>& graph);

}  // namespace placegraph
