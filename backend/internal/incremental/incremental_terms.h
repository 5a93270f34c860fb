#pragma once
#include <placegraph/backend/factors/pose_error.h>
#include <placegraph/backend/internal/solver/packed_graph.h>

namespace placegraph {

/// An edge of a packed graph with its cost and gradient at the present poses and its normal matrix
/// at those where it was linearized.
template <class Group>
struct EdgeTerm {
  using Tangent = typename Group::Tangent;
  using Jacobian = typename Group::Jacobian;

  typename PackedGraph<Group>::Edge edge;
  double cost = 0;                                           ///< weight * rho(e^T Omega e)
  Tangent g_from = Tangent::Zero(), g_to = Tangent::Zero();  ///< half its derivatives
  Jacobian J_from, J_to;                                     ///< as linearized
  double scale = -1;  ///< weight * rho' as linearized; negative: never was
  /// How far the Jacobians are from those as linearized, as a share of their norm; the same of the
  /// scale if that is more.
  double change = 0;

  struct NormalBlocks {
    Jacobian from_from, from_to, to_to;
  };

  void evaluate(const Group& T_world_from, const Group& T_world_to, RotationError kind);
  NormalBlocks linearize(const Group& T_world_from, const Group& T_world_to, RotationError kind);
};

/// The same of a measured position, which is linearized whenever it is evaluated.
template <class Group>
struct PositionTerm {
  typename PackedGraph<Group>::Position position;
  double cost = 0;
  typename Group::Tangent g = Group::Tangent::Zero();

  typename Group::Jacobian evaluate(const Group& T_world_node);  ///< returns the normal matrix
};

}  // namespace placegraph
