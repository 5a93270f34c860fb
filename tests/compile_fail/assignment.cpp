// A number assigned to an id.
#include <placegraph/graph/core/ids.h>

namespace placegraph {
void wrong(FrameId& frame) { frame = 3; }
}  // namespace placegraph
