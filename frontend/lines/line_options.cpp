#include <placegraph/frontend/lines/line_options.h>

namespace placegraph {

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
