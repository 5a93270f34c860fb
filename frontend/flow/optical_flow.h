#pragma once
#include <placegraph/frontend/flow/flow_options.h>
#include <placegraph/graph/image/image.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Displacements from one image to the next (CV_8UC1, of one size).
///
/// CV_32FC2, (du, dv) in pixels, NaN where the method has no result or only normal flow. Methods
/// that measure points have NaN between those of the grid (or between key-pixels). Throws
/// ArgumentError.
Image optical_flow(const Image& from, const Image& to, const FlowOptions& options);

}  // namespace placegraph
