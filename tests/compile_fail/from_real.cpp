// An id made of a number that is no integer.
#include <placegraph/graph/core/ids.h>

namespace placegraph {
FrameId wrong(double seconds) { return FrameId(seconds); }
}  // namespace placegraph
