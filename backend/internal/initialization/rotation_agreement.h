#pragma once
#include <placegraph/graph/pose_graph/pose_graph.h>

#include <vector>

namespace placegraph {

/// Cosine of a rotation's angle.
double cosine_of(const SO2& R);
double cosine_of(const SO3& R);

/// Whether two estimates are turned against each other nowhere by more than 0.3 rad, each relative
/// to its own first pose, whatever holds the gauge. Noise turns no pose by more than that within
/// one minimum: a descent from either ends in the same.
template <class Group>
bool rotations_agree(const std::vector<Group>& a, const std::vector<Group>& b);

/// The same of two points of rank d of the isotropic chordal problem (ChordalRelaxation), of the
/// same gauge.
template <int dim>
bool points_agree(const Eigen::MatrixXd& X, const Eigen::MatrixXd& Z);

}  // namespace placegraph
