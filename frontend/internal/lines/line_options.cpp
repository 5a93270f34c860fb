#include <placegraph/frontend/lines/line_options.h>

namespace placegraph {

void visit(OptionVisitor& field, SegmentMergingOptions& o) {
  field("max_angle_deg", o.max_angle_deg, "between pieces of one edge", {0, 20});
  field("max_distance_px", o.max_distance_px, "of the pieces' ends from the common line", {0, 20});
  field("max_gap_px", o.max_gap_px, "between pieces", {0, 1000});
}

void visit(OptionVisitor& field, EdgeRefinementOptions& o) {
  field("reach_px", o.reach_px, "the edge is looked for so far on both sides", {1, 20});
  field("blur_px", o.blur_px, "of the image before its gradient is taken", {0.3, 5});
  field("min_gradient", o.min_gradient, "of a point of the edge, grey levels / px", {0, 255});
  field("min_support", o.min_support, "share of the segment's samples that see the edge", {0, 1});
  field("min_sigma_px", o.min_sigma_px, "no sample is better, whatever the fit says", {1e-4, 5});
}

void SegmentDetectorOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, SegmentDetectorOptions& o) {
  field("min_length_px", o.min_length_px, "shorter segments are dropped", {3, 1000});
  field("border_px", o.border_px, "edges so near along the image's border are its own", {0, 50});
  field.group("merging", o.merging, "pieces of one edge");
  field.group("refinement", o.refinement, "sub-pixel fit to the gradient");
}

void visit(OptionVisitor& field, SegmentFlowOptions& o) {
  field("strip_px", o.strip_px, "half width of the strip that is followed", {3, 30});
  field("iterations", o.iterations, "on each level", {1, 50});
  field("robust_grey", o.robust_grey, "width of the kernel on grey values", {1, 255});
  field("max_rotation_deg", o.max_rotation_deg, "from the expected direction", {1, 60});
}

void VanishingNoise::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, VanishingNoise& noise) {
  field("end_px", noise.end_px, "deviation of a segment's ends across it, to start with",
        {1e-3, 100});
  field("parallel_deg", noise.parallel_deg, "deviation of the scene's edges from parallel",
        {1e-3, 10});
  field("tail_freedom", noise.tail_freedom, "of the errors, Student t", {1, 1e6});
}

void VanishingPointOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, VanishingPointOptions& options) {
  field.group("noise", options.noise, "of the segments");
  field("samples", options.samples, "of two segments, to begin with", {1, 1e6});
  field("max_points", options.max_points, "vanishing points looked for", {1, 1000});
  field("min_segments", options.min_segments, "a vanishing point with fewer is none", {3, 1e6});
  field("point_cost", options.point_cost, "of each point beside its precision [nats]", {0, 1e6});
}

void visit(OptionVisitor& field, ManhattanOptions& options) {
  field("orthogonality_deg", options.orthogonality_deg,
        "deviation of the directions of a rectangular world from right angles", {0.01, 10});
  field("min_segments", options.min_segments, "of an axis that counts as seen", {2, 1e6});
  field("min_evidence", options.min_evidence, "of each of two axes [nats]", {0, 1e6});
  field("min_orthogonality", options.min_orthogonality,
        "log of the odds, by its angles, that a world is rectangular", {-100, 100});
}

void SceneDirectionOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, SceneDirectionOptions& options) {
  field.group("points", options.points, "vanishing points");
  field.group("manhattan", options.manhattan, "rectangular worlds");
  field("off_right_deg", options.off_right_deg,
        "deviation of further points from right angles to an axis", {0.01, 45});
  field("free_share", options.free_share, "of further points, that lie anywhere", {0.01, 1});
}

void LineTrackerOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, LineTrackerOptions& o) {
  field.group("detector", o.detector, "where new tracks come from");
  field.group("flow", o.flow, "alignment from frame to frame");
  field("grow_px", o.growth.beyond_px, "an edge may have become longer by, at either end",
        {0, 100});
  field("max_gap_px", o.growth.max_gap_px, "without support, inside one edge", {1, 1000});
  field("max_tracks", o.max_tracks, "lines followed at once", {1, 10000});
  field("enough_share", o.enough_share, "of max_tracks: no new ones are looked for", {0.01, 1});
  field("leaving_share", o.leaving_share,
        "of max_tracks: only with fewer are edges begun that leave the image soon", {0, 1});
  field("max_shift_px", o.max_shift_px, "of a segment from where it is expected", {1, 200});
  field("min_new_px", o.min_new_px, "length of an edge that becomes a track", {5, 1000});
  field("min_length_px", o.min_length_px, "shorter pieces die", {5, 1000});
  field("min_similarity", o.min_similarity, "correlation of its surroundings in two frames",
        {-1, 1});
  field("max_forward_backward_px", o.max_forward_backward_px,
        "disagreement with the way back, across", {0.05, 20});
  field("max_contrast_ratio", o.max_contrast_ratio, "between two frames", {1, 100});
}

void LineStereoOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, LineStereoOptions& o) {
  field.group("flow", o.flow, "alignment in the right eye");
  field("min_sine", o.min_sine, "of a segment's angle to the rows", {0.01, 1});
  field("samples", o.samples, "points along a segment that begin the search", {3, 100});
  field("max_disparity_miss_px", o.max_disparity_miss_px, "of a sample that counts", {0.1, 20});
  field("min_similarity", o.min_similarity, "correlation of its surroundings in both eyes",
        {-1, 1});
}

void visit(OptionVisitor& field, LineTriangulationOptions& o) {
  field("min_rotation_deg", o.min_rotation_deg, "between the planes through the line and two eyes",
        {0.01, 45});
  field("min_rotation_sigmas", o.min_rotation_sigmas, "the same over its standard deviation",
        {1, 1000});
  field("max_error_sigmas", o.max_error_sigmas, "of a sighting from the line", {1, 1000});
}

void PoseFromLinesOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, PoseFromLinesOptions& o) {
  field.group("ransac", o.ransac, "three-line hypotheses");
  field("threshold_px", o.threshold_px, "inliers lie within this of their projection", {0.1, 50});
  field("prior_inlier_ratio", o.prior_inlier_ratio,
        "a predicted pose that explains this share of the lines spares the RANSAC", {0, 1.01});
  field("huber_sigmas", o.huber_sigmas, "width of the Huber kernel", {0.1, 100});
}

void LineInitializerOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, LineInitializerOptions& o) {
  field.group("directions", o.directions, "vanishing points that show the rotation");
  field.group("ransac", o.ransac, "five-line hypotheses of the translations");
  field("threshold_px", o.threshold_px, "of a line of two views in the third", {0.1, 50});
  field("min_rotation_deg", o.min_rotation_deg, "of a line's plane, to take part", {0.01, 45});
  field("min_lines", o.min_lines, "seen from the first to the last view", {6, 1000});
}

void visit(OptionVisitor& field, FloorFromLinesOptions& o) {
  field("max_tilt_deg", o.max_tilt_deg, "of the floor from the camera's xz plane", {1, 80});
  field("upright_deg", o.upright_deg, "of an upright from the vertical", {0.1, 20});
  field("end_px", o.end_px, "an upright's end from where it meets the floor", {0.1, 50});
  field("unevenness", o.unevenness, "of the floor, in heights of the camera", {0, 0.5});
  field("max_sigma", o.max_sigma, "of a height with a vote, in heights of the camera", {0.001, 1});
  field("min_lines", o.min_lines, "on the floor", {2, 1000});
  field("min_share", o.min_share, "of the votes for the level that has most", {0, 1});
}

void LineFeatureMatcherOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, LineFeatureMatcherOptions& o) {
  field("max_distance", o.max_distance, "differing bits of 256", {0, 256});
  field("gate_px", o.gate_px, "between a segment and where its line is expected", {0.1, 1000});
  field("max_angle_deg", o.max_angle_deg, "between both", {0.1, 90});
  field("min_overlap", o.min_overlap, "of the shorter of two segments with the other", {0, 1});
}

}  // namespace placegraph
