#pragma once
#include <placegraph/frontend/flow/flow_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/image/image.h>

namespace placegraph {

/// Dense smooth flow after Horn & Schunck.
///
/// After "Determining optical flow", Artificial Intelligence 17, 1981: minimizes the squared change
/// of brightness plus alpha^2 times the squared gradients of the flow, from coarse to fine with
/// warping, and a median filter between warps (Sun, Roth & Black 2010). CV_32FC2, (du, dv) in
/// pixels at every pixel; NaN where the flow leaves the image. Images CV_8UC1 of one size; throws
/// ArgumentError.
Image horn_schunck(const Image& from, const Image& to, const HornSchunckOptions& options);

}  // namespace placegraph
