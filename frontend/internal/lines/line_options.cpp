#include <placegraph/frontend/lines/line_options.h>

namespace placegraph {

void visit(OptionVisitor& field, SegmentMergingOptions& o) {
  field("max_angle_deg", o.max_angle_deg, "maximum angle between pieces of one edge [deg]",
        {0, 20});
  field("max_distance_px", o.max_distance_px,
        "maximum distance of the pieces' ends from the common line [px]", {0, 20});
  field("max_gap_px", o.max_gap_px, "maximum gap between pieces, along the line [px]", {0, 1000});
}

void visit(OptionVisitor& field, EdgeRefinementOptions& o) {
  field("reach_px", o.reach_px, "search distance for the edge on both sides of the segment [px]",
        {1, 20});
  field("blur_px", o.blur_px, "standard deviation of the blur before the gradient is taken [px]",
        {0.3, 5});
  field("min_gradient", o.min_gradient,
        "minimum gradient of a point of the edge [grey levels / px]", {0, 255});
  field("min_support", o.min_support,
        "minimum share of the segment's samples at which the edge is found", {0, 1});
  field("min_sigma_px", o.min_sigma_px,
        "minimum standard deviation of a sample across the edge [px]", {1e-4, 5});
}

void SegmentDetectorOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, SegmentDetectorOptions& o) {
  field("min_length_px", o.min_length_px, "minimum length of a segment [px]", {3, 1000});
  field("border_px", o.border_px,
        "edges along the image border within this distance are left out [px]", {0, 50});
  field.group("merging", o.merging, "joining of pieces of one edge");
  field.group("refinement", o.refinement, "sub-pixel fit to the gradient");
}

void visit(OptionVisitor& field, SegmentFlowOptions& o) {
  field("strip_px", o.strip_px, "half the width of the strip [px]", {3, 30});
  field("iterations", o.iterations, "Gauss-Newton iterations on each level", {1, 50});
  field("robust_grey", o.robust_grey, "width of the Huber kernel on residuals [grey levels of 255]",
        {1, 255});
  field.formerly("max_turn_deg")("max_rotation_deg", o.max_rotation_deg,
                                 "maximum rotation from the predicted direction [deg]", {1, 60});
}

void VanishingNoise::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, VanishingNoise& noise) {
  field("end_px", noise.end_px, "initial standard deviation of a segment's ends across it [px]",
        {1e-3, 100});
  field("parallel_deg", noise.parallel_deg,
        "initial deviation of the scene's edges from parallel [deg]", {1e-3, 10});
  field("tail_freedom", noise.tail_freedom, "degrees of freedom of the errors (Student t)",
        {1, 1e6});
}

void VanishingPointOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, VanishingPointOptions& options) {
  field.group("noise", options.noise, "noise of the segments");
  field("samples", options.samples,
        "initial hypotheses of two segments; later searches use half as many", {1, 1e6});
  field("max_points", options.max_points, "maximum number of vanishing points", {1, 1000});
  field("min_segments", options.min_segments, "minimum number of segments of a vanishing point",
        {3, 1e6});
  field("point_cost", options.point_cost,
        "description length of a point beside its precision [nats]", {0, 1e6});
}

void visit(OptionVisitor& field, ManhattanOptions& options) {
  field("orthogonality_deg", options.orthogonality_deg,
        "deviation of the axes of a Manhattan frame from right angles [deg]", {0.01, 10});
  field("min_segments", options.min_segments, "minimum number of segments of an observed axis",
        {2, 1e6});
  field("min_evidence", options.min_evidence,
        "minimum evidence of each of the two best axes [nats]", {0, 1e6});
  field("min_orthogonality", options.min_orthogonality,
        "minimum log odds, from the angles between the axes, that they are orthogonal",
        {-100, 100});
}

void SceneDirectionOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, SceneDirectionOptions& options) {
  field.group("points", options.points, "vanishing points");
  field.group("manhattan", options.manhattan, "Manhattan frames");
  field("off_right_deg", options.off_right_deg,
        "deviation of further vanishing points from right angles to an axis [deg]", {0.01, 45});
  field("free_share", options.free_share,
        "prior share of further vanishing points in any direction", {0.01, 1});
}

void LineTrackerOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, LineTrackerOptions& o) {
  field.group("detector", o.detector, "detection of edges that become tracks");
  field.group("flow", o.flow, "alignment from frame to frame");
  field("grow_px", o.growth.beyond_px,
        "maximum growth of an edge at either end, from frame to frame [px]", {0, 100});
  field("max_gap_px", o.growth.max_gap_px, "maximum gap without support inside an edge [px]",
        {1, 1000});
  field("max_tracks", o.max_tracks, "maximum number of edges tracked at once", {1, 10000});
  field("enough_share", o.enough_share,
        "share of max_tracks from which on no new edges are searched", {0.01, 1});
  field("leaving_share", o.leaving_share,
        "share of max_tracks below which edges that leave the image soon become tracks", {0, 1});
  field("max_shift_px", o.max_shift_px, "maximum distance of a segment from its prediction [px]",
        {1, 200});
  field("min_new_px", o.min_new_px, "minimum length of an edge that becomes a track [px]",
        {5, 1000});
  field("min_length_px", o.min_length_px, "minimum length of a track; shorter ones end [px]",
        {5, 1000});
  field("min_similarity", o.min_similarity,
        "minimum correlation of the strips along the edge in two frames", {-1, 1});
  field("max_forward_backward_px", o.max_forward_backward_px,
        "maximum error across the edge of its ends tracked forward and back [px]", {0.05, 20});
  field("max_contrast_ratio", o.max_contrast_ratio, "maximum ratio of the contrasts in two frames",
        {1, 100});
}

void LineStereoOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, LineStereoOptions& o) {
  field.group("flow", o.flow, "alignment in the right image");
  field("min_sine", o.min_sine, "minimum sine of a segment's angle to the rows", {0.01, 1});
  field("samples", o.samples, "points along a segment whose disparities start the search",
        {3, 100});
  field("max_disparity_miss_px", o.max_disparity_miss_px,
        "maximum distance of an inlier from the common line [px]", {0.1, 20});
  field("min_similarity", o.min_similarity,
        "minimum correlation of the strips along the edge in both images", {-1, 1});
}

void visit(OptionVisitor& field, LineTriangulationOptions& o) {
  field.formerly("min_turn_deg")(
      "min_rotation_deg", o.min_rotation_deg,
      "minimum angle between the planes through the line and two camera centres [deg]", {0.01, 45});
  field.formerly("min_turn_sigmas")("min_rotation_sigmas", o.min_rotation_sigmas,
                                    "minimum ratio of that angle to its standard deviation",
                                    {1, 1000});
  field("max_error_sigmas", o.max_error_sigmas,
        "maximum residual of an observation [standard deviations]", {1, 1000});
}

void PoseFromLinesOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, PoseFromLinesOptions& o) {
  field.internal().group("ransac", o.ransac, "three-line hypotheses");
  field("threshold_px", o.threshold_px, "maximum distance of an inlier from its projection [px]",
        {0.1, 50});
  field("prior_inlier_ratio", o.prior_inlier_ratio,
        "share of inliers of the predicted pose that makes RANSAC unnecessary; >1: never",
        {0, 1.01});
  field("huber_sigmas", o.huber_sigmas, "width of the Huber kernel [standard deviations]",
        {0.1, 100});
}

void LineInitializerOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, LineInitializerOptions& o) {
  field.group("directions", o.directions, "vanishing points of the first image, for the rotations");
  field.internal().group("ransac", o.ransac, "five-line hypotheses of the translations");
  field("threshold_px", o.threshold_px,
        "maximum residual in the middle image of a line from the others [px]", {0.1, 50});
  field.formerly("min_turn_deg")(
      "min_rotation_deg", o.min_rotation_deg,
      "minimum rotation of a line's plane for use in the translation [deg]", {0.01, 45});
  field("min_lines", o.min_lines,
        "minimum number of lines tracked from the first to the last image", {6, 1000});
}

void visit(OptionVisitor& field, FloorFromLinesOptions& o) {
  field("max_tilt_deg", o.max_tilt_deg,
        "maximum tilt of the floor from the camera's xz plane [deg]", {1, 80});
  field("upright_deg", o.upright_deg, "deviation of vertical edges from the floor's normal [deg]",
        {0.1, 20});
  field("end_px", o.end_px,
        "standard deviation of a vertical edge's end from its floor contact [px]", {0.1, 50});
  field("unevenness", o.unevenness, "standard deviation of the floor [camera heights]", {0, 0.5});
  field("max_sigma", o.max_sigma,
        "maximum standard deviation of a height with a vote [camera heights]", {0.001, 1});
  field("min_lines", o.min_lines, "minimum number of lines on the floor", {2, 1000});
  field("min_share", o.min_share,
        "minimum ratio of the floor's votes to those of the level with most", {0, 1});
}

void LineFeatureMatcherOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, LineFeatureMatcherOptions& o) {
  field("max_distance", o.max_distance, "maximum Hamming distance of the descriptors [bits of 256]",
        {0, 256});
  field("gate_px", o.gate_px, "maximum distance of a segment from its predicted line [px]",
        {0.1, 1000});
  field("max_angle_deg", o.max_angle_deg,
        "maximum angle between a segment and its predicted line [deg]", {0.1, 90});
  field("min_overlap", o.min_overlap, "minimum share of the shorter segment that the other covers",
        {0, 1});
}

}  // namespace placegraph
