#pragma once
#include <placegraph/frontend/labels/scene_labeller.h>
#include <placegraph/frontend/scene/environment.h>

#include <array>
#include <vector>

namespace placegraph {

/// Probabilities of the kinds of environment of a view, sum 1.
using EnvironmentProbabilities = std::array<double, kEnvironmentCount>;

/// Probability of an environment in which the classes of streets apply: the sum over the kinds
/// whose assumptions include the surfaces of streets.
double street_probability(const EnvironmentProbabilities& kinds);

/// Probabilities of the kinds at each of consecutive views by the evidence of all of them.
///
/// The hidden Markov model of EnvironmentFilter, forwards and backwards. `views` are the
/// probabilities of lone views in order of travel.
std::vector<EnvironmentProbabilities> smoothed_kinds(
    const std::vector<EnvironmentProbabilities>& views,
    const EnvironmentFilterOptions& options = {});

/// Labels by the classes of streets in an image that may show none of them.
///
/// Class c of a superpixel has the probability P(street) P(c), none the probability
/// 1 - P(street). A pixel has no class (number `classes`) where that is the most probable, or where
/// its P(c) is less than `unknown_below`. `confidence` is P(c), that of the class in a street.
SceneLabels street_labels(const std::vector<float>& probabilities, int classes,
                          const SceneView& view, double street, double unknown_below = 0);

}  // namespace placegraph
