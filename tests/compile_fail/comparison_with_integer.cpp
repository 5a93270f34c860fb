// An id compared with a number.
#include <placegraph/graph/core/ids.h>

namespace placegraph {
bool wrong(FrameId frame) { return frame == 3; }
}  // namespace placegraph
