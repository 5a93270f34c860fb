#include <placegraph/frontend/features/feature_options.h>
#include <placegraph/graph/core/error.h>

namespace placegraph {

void PointTrackerOptions::check() const {
  check_ranges(*this);
  require(window_px % 2 == 1, "window_px: must be odd");
}

void visit(OptionVisitor& field, PointTrackerOptions& o) {
  field.basic()("max_tracks", o.max_tracks, "maximum number of points tracked at once",
                {20, 10000});
  field("window_px", o.window_px, "side of the Lucas-Kanade window, odd [px]", {5, 63});
  field("pyramid_levels", o.pyramid_levels, "number of levels of the image pyramid", {1, 8});
  field("max_forward_backward_px", o.max_forward_backward_px,
        "maximum error of a point tracked forward and back; beyond, the track ends [px]",
        {0.01, 10});
  field.internal()("min_eigenvalue", o.min_eigenvalue,
                   "minimum eigenvalue of the gradient matrix per pixel, for grey levels / 255",
                   {0, 1});
  field("cell_px", o.cell_px, "side of the cells over which tracks are balanced [px]", {8, 512});
  field("min_distance_px", o.min_distance_px, "minimum distance of a new point from others [px]",
        {1, 256});
  field.internal()("max_anchor_shift_px", o.max_anchor_shift_px,
                   "maximum correction of a track to its anchor at a keyframe; 0: no anchors [px]",
                   {0, 100});
  field.internal()("min_anchor_correlation", o.min_anchor_correlation,
                   "minimum correlation with the anchor; below it a new anchor is taken", {0, 1});
  field("sigma_px", o.sigma_px, "noise added at a keyframe where the anchor was not found [px]",
        {0.05, 10});
  field.retired({{"min_sigma_px", 0.25}, {"max_sigma_px", 1.5}});
}

void DetectorOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, DetectorOptions& o) {
  field.basic()("max_features", o.max_features, "maximum number of features per image",
                {50, 20000});
  field("octaves", o.octaves, "number of levels of the image pyramid", {1, 12});
  field("scale_factor", o.scale_factor, "ratio of the sizes of two pyramid levels", {1.05, 2});
  field("fast_threshold", o.fast_threshold,
        "threshold of the FAST corner test [grey levels of 255]", {1, 100});
}

void MatcherOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, MatcherOptions& o) {
  field("max_distance", o.max_distance, "maximum Hamming distance of a match [bits of 256]",
        {1, 256});
  field("max_ratio", o.max_ratio, "maximum ratio of the best to the second best distance",
        {0.1, 1});
}

void StereoMatcherOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, StereoMatcherOptions& o) {
  field("half_width_px", o.half_width_px, "half the width of the compared patches [px]", {2, 31});
  field("half_height_px", o.half_height_px, "half the height of the compared patches [px]",
        {1, 31});
  field.basic()("max_disparity_px", o.max_disparity_px, "maximum disparity searched [px]",
                {4, 1024});
  field("min_score", o.min_score, "minimum zero-mean normalized cross-correlation of a match",
        {0, 1});
  field("max_left_right_px", o.max_left_right_px,
        "maximum error of the search back into the left image [px]", {0.1, 20});
  field("sigma_disparity_px", o.sigma_disparity_px, "standard deviation of a disparity [px]",
        {0.01, 10});
}

void RectificationOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, RectificationOptions& o) {
  field.basic()(
      "enabled", o.enabled,
      "estimate the rectification error of the stereo pair and correct disparities by it");
  field("prior_sigma_px", o.prior_sigma_px,
        "initial standard deviation of offset, by_x and by_y [px]", {1e-3, 10});
  field("batch_sigma_px", o.batch_sigma_px,
        "standard deviation of the error common to the samples of a keyframe [px]", {1e-3, 10});
  field("scale_sigma", o.scale_sigma, "initial relative standard deviation of the motion's scale",
        {1e-5, 1});
  field("scale_drift", o.scale_drift, "random walk of the motion's scale from keyframe to keyframe",
        {1e-6, 1});
}

void visit(OptionVisitor& field, WideMatcherOptions& o) {
  field("max_features", o.max_features, "maximum number of features of an image", {50, 100000});
  field("min_contrast", o.min_contrast,
        "minimum contrast of a feature, as a share of the grey range", {0, 1});
  field("max_ratio", o.max_ratio, "maximum ratio of the best to the second best distance",
        {0.1, 1});
  field("epipolar_px", o.epipolar_px,
        "maximum epipolar distance of an inlier of the fundamental matrix [px]", {0.1, 20});
  field("min_inliers", o.min_inliers, "minimum inliers of the fundamental matrix", {8, 10000});
}

}  // namespace placegraph
