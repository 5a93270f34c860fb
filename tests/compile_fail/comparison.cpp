// Ids of two kinds compared.
#include <placegraph/graph/core/ids.h>

namespace placegraph {
bool wrong(FrameId frame, KeyframeId keyframe) { return frame == keyframe; }
}  // namespace placegraph
