#pragma once
#include <placegraph/graph/core/id.h>

namespace placegraph {

/// A frame: its position in the sequence or folder of images that it was read from.
using FrameId = Id<struct FrameTag>;

}  // namespace placegraph
