#pragma once
#include <placegraph/frontend/internal/labels/scene_labeller.h>

namespace placegraph {

/// What each superpixel is, geometrically and semantically at once.
struct UrbanLabels {
  std::vector<float> classes;   ///< count x classes of the urban model, probabilities
  std::vector<float> surfaces;  ///< count x kSurfaceCount
};

/// Every class is one surface (a road is ground and never upright), so the pair (s, g) has
///   P(s, g | x) ~ P_urban(s | g, x) P_urban(g | x)^(1/2) P_surface(g | x)^(1/2)
/// where s is a g and 0 elsewhere: both models are asked what surface it is, the urban one which
/// class of it. Marginals over either. Throws like `classify_superpixels`, and ArgumentError for
/// models of other kinds.
UrbanLabels label_urban(const SceneModel& urban, const SceneModel& surfaces, const SceneView& view,
                        const LabellerOptions& options = {});

/// One random field over the pairs (s, g), with what else is known of the superpixels, e.g. where
/// they are in space: `log_likelihoods` of that, count x classes of the urban model, enter the
/// unary terms beside the probabilities of `alone`, which `label_urban` gave without its field.
/// Throws ArgumentError for another size.
UrbanLabels join_urban(const SceneModel& urban, const UrbanLabels& alone, const SceneView& view,
                       const std::vector<float>& log_likelihoods,
                       const LabellerOptions& options = {});

}  // namespace placegraph
