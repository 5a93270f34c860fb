#pragma once
#include <placegraph/backend/window/window_state.h>
#include <placegraph/graph/core/ids.h>

namespace placegraph {

/// Marginalizes one keyframe into the prior.
/// With it go the landmarks that end with it and the planes and Manhattan frames that no other
/// keyframe measures. A measurement leaves with the first of its variables; a measurement between
/// planes and Manhattan frames alone keeps none of them in the window.
void marginalize_keyframe(WindowState& state, KeyframeId leaving);

/// Marginalizes the oldest keyframes that are not kept until at most max_keyframes are left.
/// Returns the ids of keyframes that left.
std::vector<KeyframeId> marginalize_window(WindowState& state);

}  // namespace placegraph
