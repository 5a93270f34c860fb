#pragma once
#include <placegraph/frontend/scene/environment.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/image/frame.h>
#include <placegraph/graph/map.h>
#include <placegraph/graph/scene/scene_model.h>

#include <functional>
#include <memory>

namespace [[gnu::visibility("default")]] placegraph {

/// Evidence of one view about the kind of its environment, by its image and its depth.
///
/// It is that of the surfaces, of the straight edges and, if the frame has a depth image of its
/// camera, of the corners up to 150 m away. `surfaces`: a model of kind kSurfaces, not null
/// (ArgumentError). Throws ArgumentError also for an image of less than 32 x 32 pixels.
EnvironmentEvidence evidence_of_view(const Frame& frame, const Camera& camera,
                                     const std::shared_ptr<const SceneModel>& surfaces);

/// Probabilities of the kinds of environment around a keyframe of a map.
///
/// The evidence is that of up to 15 keyframes around it, every other one: images (read by
/// `frame_of`), straight edges and points. `surfaces`: a model of kind kSurfaces, not null
/// (ArgumentError). Throws ArgumentError for an unknown keyframe, and what `frame_of` throws.
EnvironmentProbabilities environment_around(const Map& map, KeyframeId keyframe,
                                            const Camera& camera,
                                            const std::shared_ptr<const SceneModel>& surfaces,
                                            const std::function<Frame(const Keyframe&)>& frame_of);

}  // namespace placegraph
