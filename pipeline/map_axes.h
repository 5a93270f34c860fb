#pragma once
#include <placegraph/backend/sliding_window.h>

namespace placegraph {

/// The axes of the map as a world of a sliding window.
inline constexpr std::int64_t kMapAxes = 0;

/// Puts the axes of the map into the window, if they are not there: seen once, exactly, by the
/// keyframe that is the oldest now. They hold the window (SlidingWindow::hold_world): what worlds
/// and planes say about the heading later turns the keyframes, and not the map under them.
void hold_map_axes(SlidingWindow& window);

}  // namespace placegraph
