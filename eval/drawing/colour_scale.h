#pragma once
#include <placegraph/eval/drawing/svg_canvas.h>

namespace placegraph {

/// A colour for a share from 0 (dark blue) to 1 (yellow).
/// Its lightness rises evenly, so that colour-blind readers and grey prints order the values.
Colour scale_colour(double share);

}  // namespace placegraph
