#pragma once
#include <placegraph/backend/factors/marginal_prior.h>

// Constraints by the prior of a sliding window on the pose of the whole window and on its scale,
// and functions that remove one of them, or a plane, from the prior.
namespace placegraph {

/// Whether the prior ties the window to the map: it constrains every motion of the whole window.
bool holds_pose(const MarginalPrior& prior);
/// Whether the prior constrains a scaling of the whole window about `center_map`.
bool holds_scale(const MarginalPrior& prior, const Eigen::Vector3d& center_map);
/// Relaxes the prior as by a random scaling of the window about `center_map`.
/// `sigma` is the standard deviation of the scaling's logarithm.
void relax_scale(MarginalPrior& prior, const Eigen::Vector3d& center_map, double sigma);
/// Makes the prior relative to its first keyframe, which is removed from it.
/// The pose of the whole window is marginalized.
void hold_first(MarginalPrior& prior);
/// Marginalizes the k-th plane of the prior.
void forget_plane(MarginalPrior& prior, std::size_t k);

}  // namespace placegraph
