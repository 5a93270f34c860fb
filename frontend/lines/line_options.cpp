#include <placegraph/frontend/lines/line_options.h>

namespace placegraph {

void LineTrackerOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, LineTrackerOptions& o) {
  field.group("detector", o.detector, "detection of edges that become tracks");
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
  field.retired({{"strip_px", 7},
                 {"iterations", 8},
                 {"robust_grey", 12},
                 {"max_rotation_deg", 15},
                 {"max_turn_deg", 15}},
                "flow");
}

void LineStereoOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, LineStereoOptions& o) {
  field("min_similarity", o.min_similarity,
        "minimum correlation of the strips along the edge in both images", {-1, 1});
  field.retired({{"strip_px", 7},
                 {"iterations", 8},
                 {"robust_grey", 12},
                 {"max_rotation_deg", 15},
                 {"max_turn_deg", 15}},
                "flow");
  field.retired({{"min_sine", 0.17}, {"samples", 7}, {"max_disparity_miss_px", 1.5}});
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
  field.retired({{"prior_inlier_ratio", 0.6}, {"huber_sigmas", 3}});
}

void LineInitializerOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, LineInitializerOptions& o) {
  field.group("directions", o.directions, "vanishing points of the first image, for the rotations");
  field.internal().group("ransac", o.ransac, "five-line hypotheses of the translations");
  field("min_lines", o.min_lines,
        "minimum number of lines tracked from the first to the last image", {6, 1000});
  field.retired({{"threshold_px", 3}, {"min_rotation_deg", 0.7}, {"min_turn_deg", 0.7}});
}

void visit(OptionVisitor& field, FloorFromLinesOptions& o) {
  field("max_tilt_deg", o.max_tilt_deg,
        "maximum tilt of the floor from the camera's xz plane [deg]", {1, 80});
  field("min_lines", o.min_lines, "minimum number of lines on the floor", {2, 1000});
  field.retired({{"upright_deg", 3},
                 {"end_px", 3},
                 {"unevenness", 0.01},
                 {"max_sigma", 0.1},
                 {"min_share", 0.35}});
}

}  // namespace placegraph
