#pragma once
#include <placegraph/frontend/flow/flow_vector.h>
#include <placegraph/frontend/flow/horn_schunck.h>
#include <placegraph/frontend/flow/interpolation_flow.h>
#include <placegraph/frontend/flow/key_pixel_flow.h>
#include <placegraph/frontend/flow/lucas_kanade.h>

#include <string>
#include <vector>

namespace placegraph {

/// Method of optical flow; the last three are OpenCV's.
enum class FlowMethod {
  kInterpolation,
  kLucasKanade,
  kHornSchunck,
  kKeyPixels,
  kOpencvLucasKanade,
  kFarneback,
  kDis
};

/// Options of optical flow.
struct FlowOptions {
  FlowMethod method = FlowMethod::kDis;
  int step_px = 4;  ///< spacing of the grid of points, for methods that measure single points
  InterpolationFlowOptions interpolation;
  LucasKanadeOptions lucas_kanade;
  HornSchunckOptions horn_schunck;
  KeyPixelFlowOptions key_pixels;
  void check() const;
};
void visit(OptionVisitor& field, FlowOptions& options);

/// Names of the methods in their order.
///
/// interpolation, lucas-kanade, horn-schunck, key-pixels, opencv-lucas-kanade, farneback, dis.
const std::vector<std::string>& flow_method_names();

/// Displacements from one image to the next (CV_8UC1, of one size).
///
/// CV_32FC2, (du, dv) in pixels, NaN where the method has no result or only normal flow. Methods
/// that measure points have NaN between those of the grid (or between key-pixels). Throws
/// ArgumentError.
Image optical_flow(const Image& from, const Image& to, const FlowOptions& options);

}  // namespace placegraph
