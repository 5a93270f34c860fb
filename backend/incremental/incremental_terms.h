#pragma once
#include <placegraph/backend/factors/pose_error.h>
#include <placegraph/backend/solver/packed_graph.h>

namespace placegraph {

/// An edge of a packed graph with its terms.
/// Cost and gradient are at the current poses, the normal matrix is at those where the edge was
/// linearized.
template <class Group>
struct EdgeTerm {
  using Tangent = typename Group::Tangent;
  using Jacobian = typename Group::Jacobian;

  typename PackedGraph<Group>::Edge edge;
  double cost = 0;                                           ///< weight * rho(e^T Omega e)
  Tangent g_from = Tangent::Zero(), g_to = Tangent::Zero();  ///< half the derivatives of the cost
  Jacobian J_from, J_to;                                     ///< as linearized
  double scale = -1;  ///< weight * rho' as linearized; negative: never linearized
  /// Relative change of the Jacobians since the linearization, or that of the scale if it is
  /// larger.
  double change = 0;

  struct NormalBlocks {
    Jacobian from_from, from_to, to_to;
  };

  void evaluate(const Group& T_world_from, const Group& T_world_to, RotationError kind);
  NormalBlocks linearize(const Group& T_world_from, const Group& T_world_to, RotationError kind);
};

/// A measured position with its terms, which are linearized in every evaluation.
template <class Group>
struct PositionTerm {
  typename PackedGraph<Group>::Position position;
  double cost = 0;
  typename Group::Tangent g = Group::Tangent::Zero();

  typename Group::Jacobian evaluate(const Group& T_world_node);  ///< returns the normal matrix
};

}  // namespace placegraph
