#include <placegraph/frontend/places/recognition_options.h>

namespace placegraph {

void VocabularyOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, VocabularyOptions& o) {
  field("branching", o.branching, "children of a tree node", {2, 64});
  field("depth", o.depth, "levels of the tree", {1, 6});
  field("iterations", o.iterations, "k-majority iterations per node", {1, 100});
}

void PlaceDatabaseOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, PlaceDatabaseOptions& o) {
  field.group("vocabulary", o.vocabulary, "tree of visual words, trained online");
  field("first_training", o.first_training,
        "number of keyframes at which the first vocabulary is trained", {2, 100000});
  field.retired({{"max_training_features", 60000}});
}

void LoopTwoViewOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, LoopTwoViewOptions& o) {
  field.group("pose", o.pose, "essential matrix or homography");
  field.formerly("turn").group("rotation", o.rotation, "views that differ by a rotation alone");
  field.retired({{"min_parallax_px", 4},
                 {"max_depth_spread", 0.2},
                 {"min_depths", 8},
                 {"min_depth_share", 0.6}});
}

void LoopVerifierOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, LoopVerifierOptions& o) {
  field.group("matcher", o.matcher, "descriptor matching");
  field.group("pose", o.pose, "relative pose from 3-D points to pixels");
  field.group("two_view", o.two_view, "relative pose where too few points have a depth");
  field("min_inlier_ratio", o.min_inlier_ratio,
        "minimum share of the matches that agree with the pose", {0, 1});
  field("max_angle_deg", o.max_angle_deg, "maximum rotation between the views", {1, 180});
  field.retired({{"max_distance", 60}, {"gate_px", 9}, {"max_angle_deg", 8}, {"min_overlap", 0.3}},
                "lines");
  field.retired({{"min_spread", 0.03}, {"max_scale_error", 0.15}, {"max_baseline_depths", 0.15}});
}

void PlaceRecognizerOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, PlaceRecognizerOptions& o) {
  field.group("cues", o.cues, "cues by which views are compared, and their weights");
  field.formerly("glanced")("shortlisted", o.shortlisted,
                            "number of views that pass the first comparison", {1, 1e6});
  field("short_list", o.short_list, "number of views that are compared in full", {1, 1e6});
  field("verified", o.verified,
        "number of views, best by all other cues, whose corners are compared", {0, 1e6});
  field("indexed_from", o.indexed_from,
        "number of views from which on the first comparison searches a graph", {1, 1e9});
  field("nominated", o.nominated,
        "number of views, best by each single cue, whose corners are compared", {0, 1e6});
}

void DescriberOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, DescriberOptions& o) {
  field("recognizer", o.recognizer,
        "recorded in a saved map: the recognizer that --recognizer named; no file may set it");
  field("beside", o.beside,
        "recorded in a saved map: the cues that --appearance named beside the recognizer");
  field("timeout_s", o.timeout_s, "longest time for the answer of a program to an image [s]",
        {0.001, 1e6});
  field("normalize", o.normalize, "scale descriptors to unit length: similarities are cosines");
}

void SequenceFilterOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, SequenceFilterOptions& o) {
  field("memory", o.memory, "factor on the score of the past, per image", {0, 0.999});
  field("pace_penalty", o.pace_penalty,
        "loss of score per squared difference [views] between step and pace", {0, 1e3});
  field("max_step", o.max_step, "maximum distance [views] between the predictions to two images",
        {1, 100});
  field("present", o.present, "weight of the present image alone in a prediction's confidence",
        {0, 1e3});
}

}  // namespace placegraph
