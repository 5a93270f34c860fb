#pragma once
#include <placegraph/backend/window/window_state.h>
#include <placegraph/graph/core/ids.h>

namespace placegraph {

/// Transforms a line to another frame.
Line3 moved(const Line3& line, const SE3& T_new_old);

/// Transforms a window to another frame, by T_new_old on the left.
/// This includes its measurements and the linearization points of its prior. The cost stays the
/// same.
void move_window(WindowState& state, const SE3& T_new_old);

/// Rotates the window about its oldest keyframe so that `manhattan_frame` becomes R_map_manhattan.
void rotate_window(WindowState& state, ManhattanFrameId manhattan_frame,
                   const SO3& R_map_manhattan);

/// Scales a window by `scale`.
/// All lengths are multiplied, including those of its measurements and of its prior; the oldest
/// keyframe keeps its pose. The cost stays the same (that of measured planes to first order of
/// their errors). A window without keyframes is unchanged.
void rescale_window(WindowState& state, double scale);

}  // namespace placegraph
