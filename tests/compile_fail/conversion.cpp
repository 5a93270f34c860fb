// An id made of one of another kind.
#include <placegraph/graph/core/ids.h>

namespace placegraph {
KeyframeId wrong(FrameId frame) { return KeyframeId(frame); }
}  // namespace placegraph
