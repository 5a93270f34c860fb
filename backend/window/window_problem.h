#pragma once
#include <placegraph/backend/window/window_state.h>
#include <placegraph/backend/window/window_summary.h>

namespace placegraph {

/// Minimizes the cost of the window over all its variables.
/// If the data determine no estimate, the outcome has the reason and the window is unchanged.
WindowSummary optimize_window(WindowState& state);

}  // namespace placegraph
