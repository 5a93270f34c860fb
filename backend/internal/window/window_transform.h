#pragma once
#include <placegraph/backend/internal/window/window_state.h>
#include <placegraph/graph/core/ids.h>

namespace placegraph {

/// A line in another frame.
Line3 moved(const Line3& line, const SE3& T_new_old);

/// Moves all that a window knows, its measurements and the linearization points of its prior too,
/// by T_new_old on the left: the same window in another frame. Its cost stays as it is.
void move_window(WindowState& state, const SE3& T_new_old);

/// Turns the window about its oldest keyframe so that `world` comes to lie at R_map_manhattan.
void rotate_window(WindowState& state, ManhattanFrameId manhattan_frame,
                   const SO3& R_map_manhattan);

/// The same window in another unit of length: all lengths, those of its measurements and of its
/// prior too, become `scale` times as long, the oldest keyframe stays where it is. The cost stays
/// as it is (that of measured planes to first order of their errors). A window without keyframes
/// stays as it is.
void rescale_window(WindowState& state, double scale);

}  // namespace placegraph
