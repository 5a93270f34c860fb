#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/image/image.h>

namespace placegraph {

/// Options of Horn-Schunck flow.
struct HornSchunckOptions {
  double alpha = 12;    ///< weight of smoothness against brightness [grey levels per pixel]
  int levels = 6;       ///< levels of the image pyramid; 1: the method of 1981
  int warps = 4;        ///< warps of the second image by the current flow, per level
  int iterations = 40;  ///< iterations of successive over-relaxation per warp
  int median_px = 5;    ///< side of the median filter of the flow after each warp: 1 (none), 3 or 5
  void check() const;
};
void visit(OptionVisitor& field, HornSchunckOptions& options);

/// Dense smooth flow after Horn & Schunck.
///
/// After "Determining optical flow", Artificial Intelligence 17, 1981: minimizes the squared change
/// of brightness plus alpha^2 times the squared gradients of the flow, from coarse to fine with
/// warping, and a median filter between warps (Sun, Roth & Black 2010). CV_32FC2, (du, dv) in
/// pixels at every pixel; NaN where the flow leaves the image. Images CV_8UC1 of one size; throws
/// ArgumentError.
Image horn_schunck(const Image& from, const Image& to, const HornSchunckOptions& options);

}  // namespace placegraph
