#include <placegraph/frontend/places/recognition_options.h>

namespace placegraph {

void VocabularyOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, VocabularyOptions& o) {
  field("branching", o.branching, "children of a tree node", {2, 64});
  field("depth", o.depth, "levels of the tree", {1, 6});
  field("iterations", o.iterations, "k-majority rounds per node", {1, 100});
}

void PlaceDatabaseOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, PlaceDatabaseOptions& o) {
  field.group("vocabulary", o.vocabulary, "tree of visual words, trained from the run itself");
  field("first_training", o.first_training, "views before the first vocabulary", {2, 100000});
  field("max_training_features", o.max_training_features, "features a training looks at",
        {100, 10000000});
}

void CornerAgreementOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, CornerAgreementOptions& o) {
  field("width_px", o.width_px, "images are brought to this width for their corners", {64, 4096});
  field("max_corners", o.max_corners, "of an image", {50, 5000});
  field("max_distance", o.max_distance, "differing bits of 256 of two descriptors", {1, 256});
  field("max_ratio", o.max_ratio, "best over second best distance", {0.1, 1});
  field("tolerance", o.tolerance, "share of the width, where a corner should be", {0.001, 1});
}

void PlaceCueOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, PlaceCueOptions& o) {
  field("tiny", o.tiny, "weight of the shrunk image", {0, 100});
  field("colour", o.colour, "weight of the colour histograms", {0, 100});
  field("gradients", o.gradients, "weight of the gradient histograms", {0, 100});
  field("corners", o.corners, "weight of agreeing corners, per e-fold", {0, 100});
  field("gabor", o.gabor, "weight of the answers of a Gabor filter bank", {0, 100});
  field("corner_floor", o.corner_floor, "corners that agree by chance", {1, 1000});
  field("tiny_columns", o.tiny_columns, "cells of the shrunk image", {8, 128});
  field("zoom", o.zoom, "a query is also looked at larger and smaller by this", {1, 2});
  field("shift_loss", o.shift_loss, "of similarity where nothing overlaps", {0, 1});
  field.group("corner_agreement", o.corner_agreement, "corners in one similarity");
}

void LoopTwoViewOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, LoopTwoViewOptions& o) {
  field.group("pose", o.pose, "essential matrix or homography");
  field.group("turn", o.turn, "views that differ by a turn alone");
  field("min_parallax_px", o.min_parallax_px, "median displacement that the rotation leaves",
        {0.1, 1000});
  field("min_depths", o.min_depths, "known depths that must agree on the length of the way",
        {3, 1000});
  field("max_depth_spread", o.max_depth_spread, "of their ratios (logarithm) from the median",
        {0.01, 2});
  field("min_depth_share", o.min_depth_share, "of the depths that must agree", {0, 1});
}

void LoopVerifierOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, LoopVerifierOptions& o) {
  field.group("matcher", o.matcher, "descriptor matching");
  field.group("pose", o.pose, "relative pose from 3-D points to pixels");
  field.group("two_view", o.two_view, "relative pose where too few points have a depth");
  field.group("lines", o.lines, "lines that the pose expects in the query");
  field("min_inlier_ratio", o.min_inlier_ratio, "share of the matches that must agree", {0, 1});
  field("min_spread", o.min_spread, "share of the image the inliers must cover", {0, 1});
  field("max_scale_error", o.max_scale_error, "disagreement of depths seen from both sides",
        {0, 10});
  field("max_baseline_depths", o.max_baseline_depths,
        "translation between the views over the median depth of the inliers", {0.01, 100});
  field("max_angle_deg", o.max_angle_deg, "rotation between the views", {1, 180});
}

void PlaceRecognizerOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, PlaceRecognizerOptions& o) {
  field.group("cues", o.cues, "what tells places apart, and how much each counts");
  field("shortlisted", o.shortlisted, "views that pass the first look", {1, 1e6});
  field("short_list", o.short_list, "of those, views compared in full", {1, 1e6});
  field("verified", o.verified, "first views by all grids whose corners are compared", {0, 1e6});
  field("indexed_from", o.indexed_from, "views from which a graph serves the first look", {1, 1e9});
  field("nominated", o.nominated, "first views by each cue whose corners are compared", {0, 1e6});
}

void SequenceFilterOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, SequenceFilterOptions& o) {
  field("memory", o.memory, "weight of the past against the present image", {0, 0.999});
  field("pace_penalty", o.pace_penalty, "per squared view a step is off the pace", {0, 1e3});
  field("max_step", o.max_step, "views between the answers of two images", {1, 100});
  field("present", o.present, "weight of the present image in how sure an answer is", {0, 1e3});
}

}  // namespace placegraph
