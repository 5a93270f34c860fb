// A frame's id where a keyframe's is due.
#include <placegraph/graph/core/ids.h>

namespace placegraph {
void take(KeyframeId) {}
void wrong(FrameId frame) { take(frame); }
}  // namespace placegraph
