#pragma once
#include <placegraph/graph/core/options.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

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

/// Names of the methods in their order.
///
/// interpolation, lucas-kanade, horn-schunck, key-pixels, opencv-lucas-kanade, farneback, dis.
const std::vector<std::string>& flow_method_names();

/// Options of the flow by image interpolation.
struct InterpolationFlowOptions {
  int radius_px = 7;          ///< the side of the patch is 2 radius + 1
  double fwhm_px = 10;        ///< full width of the patch's Gaussian weight at half of the maximum
  int levels = 3;             ///< levels of the pyramid; references have the same shift on each
  int shift_px = 1;           ///< shift of the references on each level
  double rotation_rad = 0.1;  ///< rotation of the references about the patch's centre
  bool rotates = true;        ///< estimate the rotation, on the finest level only
  int iterations = 4;         ///< maximum number of iterations on each level
  double epsilon_px = 0.01;   ///< a step shorter than this ends the iterations
  double min_eigenvalue = 3e-5;  ///< minimum, of the gradient matrix per pixel, grey levels / 255
  double max_residual = 0.08;    ///< maximum RMS of the residual, grey levels / 255
  void check() const;
};
void visit(OptionVisitor& field, InterpolationFlowOptions& options);

/// Options of pyramidal Lucas-Kanade.
struct LucasKanadeOptions {
  int window_px = 21;              ///< side of the window, odd
  int levels = 4;                  ///< levels of the image pyramid
  int iterations = 30;             ///< maximum number of iterations on each level
  double epsilon_px = 0.01;        ///< a step shorter than this ends the iteration of a level
  double min_eigenvalue = 3e-5;    ///< minimum, of the gradient matrix per pixel, grey levels / 255
  double max_return_error_px = 1;  ///< maximum forward-backward error; 0: no check
  void check() const;
};
void visit(OptionVisitor& field, LucasKanadeOptions& options);

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

/// Options of the flow at key-pixels.
struct KeyPixelFlowOptions {
  int max_key_pixels = 2000;  ///< maximum number of key-pixels per image, the strongest ones
  double max_flow_px = 100;   ///< maximum distance of partners
  double max_ratio = 0.8;  ///< maximum ratio of the descriptor distances of the two best partners
  double max_scale_ratio = 1.6;  ///< maximum ratio of the sizes of partners
  void check() const;
};
void visit(OptionVisitor& field, KeyPixelFlowOptions& options);

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

}  // namespace placegraph
