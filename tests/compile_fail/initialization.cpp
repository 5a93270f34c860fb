// An id that is initialized with a number, without saying so.
#include <placegraph/graph/core/ids.h>

namespace placegraph {
FrameId wrong() { return 3; }
}  // namespace placegraph
