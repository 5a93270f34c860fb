#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/core/robust_kernel.h>
#include <placegraph/graph/geometry/se2.h>
#include <placegraph/graph/geometry/se3.h>
#include <placegraph/graph/geometry/sim3.h>

#include <cstdint>
#include <variant>

namespace [[gnu::visibility("default")]] placegraph {

/// A pose of the graph, `T_world_node`. All nodes of one graph are of one kind.
using Pose = std::variant<SE2, SE3, Sim3>;
/// The kind of a pose, in the order of the alternatives of Pose.
enum class PoseKind { kSE2, kSE3, kSim3 };

/// The kind of a pose.
inline PoseKind kind_of(const Pose& pose) { return static_cast<PoseKind>(pose.index()); }
/// Size of the tangent: 3, 6 or 7.
int degrees_of_freedom(PoseKind kind);

/// Symmetric, positive semi-definite, of any rank; order of the tangent: translation, rotation,
/// log scale. At most 7x7, without heap.
using Information = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 7, 7>;

/// The source of a constraint: robust methods accept odometry and test loops.
enum class ConstraintSource { kOdometry, kLoop, kOther };

/// The fault of an information matrix, as in "information is indefinite"; nullptr if none.
/// Faults are values that are not finite, asymmetry (beyond 1e-9 of the largest entry), an
/// eigenvalue below -1e-9 of the largest, all zeros, and any size but 3x3, 6x6 and 7x7.
const char* fault_of(const Information& information);
/// The same for a matrix of fixed size, as for a position.
const char* fault_of(const Eigen::Matrix3d& information);

/// Parametrization of the rotation part of a relative-pose error.
/// A .g2o file does not specify it, so that the same file has several costs.
enum class RotationError {
  kLog,  ///< Log of SE(2) / SE(3) / Sim(3): the default
  /// g2o: translation of the error pose, vector part of its quaternion (half the angle); in the
  /// plane, where g2o has no quaternion, translation and angle.
  kQuaternion,
};

/// The measured pose of node `to` relative to node `from`:
/// error = Log(T_from_to^-1 * T_world_from^-1 * T_world_to).
struct RelativePoseConstraint {
  NodeId from, to;          ///< two different nodes
  Pose T_from_to;           ///< measured pose, of the kind of the nodes
  Information information;  ///< information of the error, in the right tangent
  ConstraintSource source = ConstraintSource::kOdometry;  ///< source of the measurement
  RobustKernel kernel;  ///< kernel of e^T Omega e; none by default
};

/// The measured position [m] of a point that a node carries, such as a GPS antenna:
/// error = T_world_node * lever_arm - position_world. In the plane the third components are
/// ignored.
struct PositionConstraint {
  NodeId node;                                               ///< the node that carries the point
  Eigen::Vector3d position_world = Eigen::Vector3d::Zero();  ///< measured position [m]
  /// Position of the point in the node's frame [m].
  Eigen::Vector3d lever_arm = Eigen::Vector3d::Zero();
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity();  ///< information of the error [1/m^2]
  RobustKernel kernel;  ///< kernel of e^T Omega e; none by default
};

/// A constraint of a pose graph.
using Constraint = std::variant<RelativePoseConstraint, PositionConstraint>;

}  // namespace placegraph
