#pragma once
#include <placegraph/backend/internal/factors/marginal_prior.h>

// What the prior of a sliding window says of where the window lies as a whole and of its unit of
// length, and how it is made to forget one of them, or a plane.
namespace placegraph {

/// Whether the prior ties the window to the map: it resists every motion of all of it.
bool holds_pose(const MarginalPrior& prior);
/// Whether the prior resists a growth of all the window about `center_map`.
bool holds_scale(const MarginalPrior& prior, const Eigen::Vector3d& center_map);
/// The prior of a window that has grown about `center_map` by a random logarithm of deviation
/// `sigma`.
void relax_scale(MarginalPrior& prior, const Eigen::Vector3d& center_map, double sigma);
/// The prior of the window relative to its first keyframe, which has no columns any more: where all
/// of it lies together is integrated out.
void hold_first(MarginalPrior& prior);
/// The prior with the k-th of its planes integrated out.
void forget_plane(MarginalPrior& prior, std::size_t k);

}  // namespace placegraph
