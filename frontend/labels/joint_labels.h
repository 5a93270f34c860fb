#pragma once
#include <placegraph/frontend/labels/scene_labeller.h>

namespace placegraph {

/// Joint geometric and semantic labels of superpixels.
struct JointLabels {
  std::vector<float> classes;   ///< count x classes of the urban model, probabilities
  std::vector<float> surfaces;  ///< count x kSurfaceCount
};

/// Labels superpixels by both models.
///
/// Every class is one surface (a road is ground and never upright), so that the pair (s, g) has
/// P(s, g | x) ~ P_urban(s | g, x) P_urban(g | x)^(1/2) P_surface(g | x)^(1/2)
/// if s is a g and 0 otherwise: both models estimate the surface, and the urban one its class. The
/// results are the marginals over either. Throws like `classify_superpixels`, and ArgumentError for
/// models of other kinds.
JointLabels label_jointly(const SceneModel& urban, const SceneModel& surfaces,
                          const SceneView& view, const LabellerOptions& options = {});

/// Adds further evidence of the superpixels, e.g. their positions in space, by one random field.
///
/// The field is over the pairs (s, g). The `log_likelihoods` of the evidence, count x classes of
/// the urban model, enter the unary terms beside the probabilities of `alone`, the result of
/// `label_jointly` without its field. Throws ArgumentError for another size.
JointLabels join_evidence(const SceneModel& urban, const JointLabels& alone, const SceneView& view,
                          const std::vector<float>& log_likelihoods,
                          const LabellerOptions& options = {});

/// Labels by the classes of streets in an image that may show none of them.
///
/// Class c of a superpixel has the probability P(street) P(c), none the probability
/// 1 - P(street). A pixel has no class (number `classes`) where that is the most probable, or where
/// its P(c) is less than `unknown_below`. `confidence` is P(c), that of the class in a street.
SceneLabels street_labels(const std::vector<float>& probabilities, int classes,
                          const SceneView& view, double street, double unknown_below = 0);

}  // namespace placegraph
