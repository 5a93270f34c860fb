#include <placegraph/frontend/flow/flow_options.h>
#include <placegraph/graph/core/error.h>

namespace placegraph {

const std::vector<std::string>& flow_method_names() {
  static const std::vector<std::string> kNames = {
      "interpolation",       "lucas-kanade", "horn-schunck", "key-pixels",
      "opencv-lucas-kanade", "farneback",    "dis"};
  return kNames;
}

void InterpolationFlowOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, InterpolationFlowOptions& o) {
  field("radius_px", o.radius_px, "half the side of the patch [px]", {2, 64});
  field("fwhm_px", o.fwhm_px,
        "full width of the patch's Gaussian weight at half of the maximum [px]", {1, 128});
  field("levels", o.levels, "number of levels of the image pyramid", {1, 8});
  field("shift_px", o.shift_px, "shift of the shifted references on each level [px]", {1, 16});
  field("rotation_rad", o.rotation_rad, "rotation of the rotated references [rad]", {0.001, 0.5});
  field("rotates", o.rotates, "estimate the rotation of the patch, on the finest level");
  field("iterations", o.iterations, "maximum number of iterations on each level", {1, 50});
  field("epsilon_px", o.epsilon_px, "a step shorter than this ends the iterations [px]", {1e-4, 1});
  field("min_eigenvalue", o.min_eigenvalue,
        "minimum eigenvalue of the gradient matrix per pixel, for grey levels / 255", {0, 1});
  field("max_residual", o.max_residual, "maximum RMS of the residual, for grey levels / 255",
        {0, 1});
}

void LucasKanadeOptions::check() const {
  check_ranges(*this);
  require(window_px % 2 == 1, "window_px: must be odd");
}

void visit(OptionVisitor& field, LucasKanadeOptions& o) {
  field("window_px", o.window_px, "side of the window, odd [px]", {3, 63});
  field("levels", o.levels, "number of levels of the image pyramid", {1, 8});
  field("iterations", o.iterations, "maximum number of iterations on each level", {1, 100});
  field("epsilon_px", o.epsilon_px, "a step shorter than this ends the iterations of a level [px]",
        {1e-4, 1});
  field("min_eigenvalue", o.min_eigenvalue,
        "minimum eigenvalue of the gradient matrix per pixel, for grey levels / 255", {0, 1});
  field("max_return_error_px", o.max_return_error_px,
        "maximum forward-backward error; 0: no check [px]", {0, 10});
}

void HornSchunckOptions::check() const {
  check_ranges(*this);
  require(median_px % 2 == 1, "median_px: must be odd");
}

void visit(OptionVisitor& field, HornSchunckOptions& o) {
  field("alpha", o.alpha, "weight of smoothness against brightness [grey levels per pixel]",
        {0.01, 1000});
  field("levels", o.levels, "levels of the image pyramid; 1: the method of 1981", {1, 12});
  field("warps", o.warps, "warps of the second image by the current flow, per level", {1, 50});
  field("iterations", o.iterations, "iterations of successive over-relaxation per warp", {1, 1000});
  field("median_px", o.median_px, "side of the median filter after each warp; 1: none [px]",
        {1, 5});
}

void KeyPixelFlowOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, KeyPixelFlowOptions& o) {
  field("max_key_pixels", o.max_key_pixels,
        "maximum number of key-pixels per image, the strongest ones", {10, 100000});
  field("max_flow_px", o.max_flow_px, "maximum distance of partners [px]", {1, 10000});
  field("max_ratio", o.max_ratio,
        "maximum ratio of the descriptor distances of the two best partners", {0.1, 1});
  field("max_scale_ratio", o.max_scale_ratio, "maximum ratio of the sizes of partners", {1, 10});
}

void FlowOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, FlowOptions& o) {
  field.choice("method", o.method, flow_method_names(), "method of optical flow");
  field("step_px", o.step_px, "spacing of the grid, for methods that measure single points [px]",
        {1, 1000});
  field.group("interpolation", o.interpolation, "image interpolation");
  field.group("lucas_kanade", o.lucas_kanade, "Lucas-Kanade, placegraph's and OpenCV's");
  field.group("horn_schunck", o.horn_schunck, "Horn-Schunck");
  field.group("key_pixels", o.key_pixels, "flow at key-pixels");
}

}  // namespace placegraph
