// A line looked up among the planes of a window.
#include <placegraph/backend/window/sliding_window.h>

namespace placegraph {
bool wrong(const SlidingWindow& window, LineId line) { return window.plane(line).has_value(); }
}  // namespace placegraph
