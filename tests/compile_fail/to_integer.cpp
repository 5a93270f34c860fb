// An id that turns into a number by itself.
#include <placegraph/graph/core/ids.h>

namespace placegraph {
std::int64_t wrong(FrameId frame) { return frame; }
}  // namespace placegraph
