#pragma once
#include <placegraph/frontend/scene/street_trust.h>
#include <placegraph/graph/map.h>
#include <placegraph/pipeline/cues/surface_labels.h>

#include <functional>

namespace placegraph {

/// Probabilities of the kinds of environment around a keyframe of a map.
///
/// The evidence is that of up to 15 keyframes around it, every other one: images (read by
/// `frame_of`), straight edges and points. Throws ArgumentError for an unknown keyframe, and what
/// `frame_of` throws.
EnvironmentProbabilities environment_around(const Map& map, KeyframeId keyframe,
                                            const Camera& camera, const SurfaceLabeller& labeller,
                                            const std::function<Frame(const Keyframe&)>& frame_of);

}  // namespace placegraph
