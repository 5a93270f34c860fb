#pragma once
#include <placegraph/eval/alignment/alignment_options.h>
#include <placegraph/eval/association/frame_pair.h>
#include <placegraph/graph/core/outcome.h>

#include <string>
#include <vector>

namespace placegraph {

/// The vertical of the ground truth's world.
struct VerticalResult {
  Outcome outcome;                                    ///< kDegenerate if none is evident
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();    ///< unit vector in the truth's world
  std::string text;                                   ///< "z", "y (estimated)", in words
};

/// The axis that `choice` names, or the one about which the truth turns.
///
/// Estimated is the main axis of the truth's rotations from frame to frame, if it has four times
/// the power of the others, or else the normal of the plane that its positions lie in. An axis of
/// the world that is within ten degrees of it is taken as exact: worlds whose gravity is known have
/// an axis along it. Outcome: kDegenerate if neither is evident.
[[nodiscard]] VerticalResult vertical_of(const std::vector<FramePair>& pairs, bool has_orientation,
                                         Vertical choice);

/// Eigenvectors (columns) and eigenvalues, ascending, of the covariance of positions [m^2].
struct PositionSpread {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  Eigen::Vector3d variances_m2 = Eigen::Vector3d::Zero();
};
PositionSpread spread_of(const std::vector<Eigen::Vector3d>& positions_m);

/// The world's axis within ten degrees of a unit vector, as "x", "y" or "z"; empty if none is.
std::string axis_name(const Eigen::Vector3d& direction);

}  // namespace placegraph
