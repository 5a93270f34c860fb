#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/image/image.h>

namespace placegraph {

struct HornSchunckOptions {
  double alpha = 12;    ///< smoothness against brightness [grey levels per pixel]
  int levels = 6;       ///< of the image pyramid; 1: the method of 1981
  int warps = 4;        ///< per level: the second image is moved by the flow and seen anew
  int iterations = 40;  ///< of successive over-relaxation per warp
  int median_px = 5;    ///< filter of the flow after each warp: 1 (none), 3 or 5
  void check() const;
};
void visit(OptionVisitor& field, HornSchunckOptions& options);

/// Dense flow as smooth as the images let it be (Horn & Schunck, "Determining optical flow",
/// Artificial Intelligence 17, 1981): minimizes the squared change of brightness plus alpha^2 times
/// the squared gradients of the flow, from coarse to fine with warping, and a median filter between
/// warps (Sun, Roth & Black 2010). CV_32FC2, (du, dv) in pixels at every pixel; NaN where it leads
/// out of the image. Images CV_8UC1 of one size; throws ArgumentError.
Image horn_schunck(const Image& from, const Image& to, const HornSchunckOptions& options);

}  // namespace placegraph
