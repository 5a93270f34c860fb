// An id that is calculated with.
#include <placegraph/graph/core/ids.h>

namespace placegraph {
FrameId wrong(FrameId frame) { return FrameId(frame + 1); }
}  // namespace placegraph
