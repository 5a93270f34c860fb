#pragma once
#include <placegraph/backend/internal/window/window_state.h>
#include <placegraph/backend/internal/window/window_summary.h>

namespace placegraph {

/// Minimizes over all of the window. The outcome says why the data determine no estimate: then the
/// window stays as it is.
WindowSummary optimize_window(WindowState& state);

}  // namespace placegraph
