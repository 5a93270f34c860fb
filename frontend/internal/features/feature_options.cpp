#include <placegraph/frontend/features/feature_options.h>
#include <placegraph/graph/core/error.h>

namespace placegraph {

void PointTrackerOptions::check() const {
  check_ranges(*this);
  require(window_px % 2 == 1, "window_px: must be odd");
}

void visit(OptionVisitor& field, PointTrackerOptions& o) {
  field("max_tracks", o.max_tracks, "points followed at once", {20, 10000});
  field("window_px", o.window_px, "side of the Lucas-Kanade window, odd", {5, 63});
  field("pyramid_levels", o.pyramid_levels, "levels of the image pyramid", {1, 8});
  field("max_forward_backward_px", o.max_forward_backward_px,
        "a track that does not come back to its start this closely is dropped", {0.01, 10});
  field("min_eigenvalue", o.min_eigenvalue,
        "least eigenvalue of the gradient matrix per pixel, grey levels / 255", {0, 1});
  field("cell_px", o.cell_px, "side of the cells over which tracks are balanced", {8, 512});
  field("min_distance_px", o.min_distance_px, "least distance between detected points", {1, 256});
  field("max_anchor_shift_px", o.max_anchor_shift_px,
        "at keyframes a track goes to where its first look is, at most this far; 0: never",
        {0, 100});
  field("min_anchor_correlation", o.min_anchor_correlation,
        "with the first look; below, the look is taken anew", {0, 1});
  field("sigma_px", o.sigma_px, "noise of a step where the first look was not found", {0.05, 10});
  field("min_sigma_px", o.min_sigma_px, "noise, at least, of a look that is found", {0.01, 10});
  field("max_sigma_px", o.max_sigma_px, "a track that has gathered more noise ends", {0.1, 100});
}

void DetectorOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, DetectorOptions& o) {
  field("max_features", o.max_features, "described points per keyframe", {50, 20000});
  field("octaves", o.octaves, "pyramid levels", {1, 12});
  field("scale_factor", o.scale_factor, "between pyramid levels", {1.05, 2});
  field("fast_threshold", o.fast_threshold, "FAST corner threshold, grey levels", {1, 100});
}

void MatcherOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, MatcherOptions& o) {
  field("max_distance", o.max_distance, "differing bits of 256", {1, 256});
  field("max_ratio", o.max_ratio, "best over second best distance", {0.1, 1});
}

void StereoMatcherOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, StereoMatcherOptions& o) {
  field("half_width_px", o.half_width_px, "half width of the compared patches", {2, 31});
  field("half_height_px", o.half_height_px, "half height of the compared patches", {1, 31});
  field("max_disparity_px", o.max_disparity_px, "greatest disparity looked for", {4, 1024});
  field("min_score", o.min_score, "ZNCC of an accepted match", {0, 1});
  field("max_left_right_px", o.max_left_right_px, "disagreement with the search back", {0.1, 20});
  field("sigma_disparity_px", o.sigma_disparity_px, "noise of the disparity", {0.01, 10});
}

void RectificationOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, RectificationOptions& o) {
  field("enabled", o.enabled, "estimate what the eyes' rectification is off by while driving");
  field("prior_sigma_px", o.prior_sigma_px,
        "of the offset, and of its growth over a unit of x and y, before anything was seen",
        {1e-3, 10});
  field("batch_sigma_px", o.batch_sigma_px, "error common to the samples of one keyframe",
        {1e-3, 10});
  field("scale_sigma", o.scale_sigma, "of the motion's unit before anything was seen", {1e-5, 1});
  field("scale_drift", o.scale_drift, "of the motion's unit, from keyframe to keyframe", {1e-6, 1});
}

}  // namespace placegraph
