#pragma once
#include <placegraph/graph/pose_graph/pose_graph.h>

#include <vector>

namespace placegraph {

/// Cosine of a rotation's angle.
double cosine_of(const SO2& R);
double cosine_of(const SO3& R);

/// Whether the rotations of two estimates differ by at most 0.3 rad for every pose.
/// Each estimate is relative to its own first pose, so the gauge has no effect. Within one minimum
/// noise rotates no pose by more than that: descents from both end in the same minimum.
template <class Group>
bool rotations_agree(const std::vector<Group>& a, const std::vector<Group>& b);

/// The same for two points of rank d of the isotropic chordal problem (ChordalRelaxation), with the
/// same gauge.
template <int dim>
bool points_agree(const Eigen::MatrixXd& X, const Eigen::MatrixXd& Z);

}  // namespace placegraph
