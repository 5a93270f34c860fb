#pragma once
#include <placegraph/frontend/features/feature_options.h>
#include <placegraph/frontend/lines/line_options.h>
#include <placegraph/frontend/places/cues/place_cue_options.h>
#include <placegraph/frontend/relative_pose/relative_pose_options.h>
#include <placegraph/graph/core/options.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// Combination of the evidence of past images with that of the present one (SequenceFilter).
struct SequenceFilterOptions {
  double memory = 0.9;  ///< factor on the score of the past, per image
  /// Loss of score per squared difference [views] between step and pace.
  double pace_penalty = 0.4;
  int max_step = 3;  ///< maximum distance [views] between the predictions to two consecutive images
  double present = 0.5;  ///< weight of the present image alone in a prediction's confidence
  void check() const;
};
void visit(OptionVisitor& field, SequenceFilterOptions& options);

/// A tree of visual words for binary descriptors.
struct VocabularyOptions {
  int branching = 16;  ///< children of a node
  int depth = 3;       ///< levels of the tree; at most branching^depth words
  int iterations = 5;  ///< k-majority iterations per node
  void check() const;
};
void visit(OptionVisitor& field, VocabularyOptions& options);

/// Retrieval of keyframes by visual words, with a vocabulary that is trained online.
struct PlaceDatabaseOptions {
  VocabularyOptions vocabulary;  ///< the visual words
  int first_training = 20;       ///< number of keyframes at which the first vocabulary is trained
  void check() const;
};
void visit(OptionVisitor& field, PlaceDatabaseOptions& options);

/// Search of PlaceRecognizer in its stored views.
struct PlaceRecognizerOptions {
  PlaceCueOptions cues;   ///< cues by which views are compared
  int shortlisted = 300;  ///< number of views that pass the first, coarsest comparison
  /// Number of views that pass the second comparison and are compared in full.
  int short_list = 60;
  int verified = 12;  ///< number of views, best by all other cues, whose corners are compared
  int nominated = 8;  ///< number of views, best by each single cue, whose corners are also compared
  /// Number of views from which on the first comparison searches a graph of neighbours.
  int indexed_from = 20000;
  void check() const;
};
void visit(OptionVisitor& field, PlaceRecognizerOptions& options);

/// Descriptors of images by a recognizer that is not the library's (docs/recognizers.md).
struct DescriberOptions {
  /// Name of the recognizer, as `--recognizer` of the command or an argument of the program has it.
  /// Only these set it; a saved map records it, and nothing is opened by it.
  std::string recognizer;
  std::string beside;     ///< appearance cues beside it, joined by commas; empty: none
  double timeout_s = 30;  ///< longest time for the answer of a program to an image
  bool normalize = true;  ///< scale descriptors to unit length: similarities are cosines
  void check() const;
};
void visit(OptionVisitor& field, DescriberOptions& options);

/// Relative pose of a loop from two images, for keyframes with too few points of known depth.
struct LoopTwoViewOptions {
  /// Essential matrix or homography.
  Pose2d2dOptions pose{.ransac = {.max_iterations = 400, .confidence = 0.9999, .min_inliers = 50},
                       .threshold_px = 1.5};
  Rotation2d2dOptions rotation;  ///< model of images that differ by a rotation alone
  void check() const;
};
void visit(OptionVisitor& field, LoopTwoViewOptions& options);

/// Geometric verification of a loop candidate.
struct LoopVerifierOptions {
  /// Matching of the two keyframes' features.
  MatcherOptions matcher{.max_distance = 60, .max_ratio = 0.85};
  /// Pose from points of known depth; the result needs min_inliers agreeing points and lines.
  Pose3d2dOptions pose{.ransac = {.max_iterations = 400, .confidence = 0.9999, .min_inliers = 40},
                       .threshold_px = 3.0,
                       .prior_inlier_ratio = 1.01};
  LoopTwoViewOptions two_view;     ///< pose if too few points have a depth for `pose`
  double min_inlier_ratio = 0.35;  ///< minimum share of the matches that agree with the pose
  double max_angle_deg = 40;       ///< maximum rotation between the keyframes
  void check() const;
};
void visit(OptionVisitor& field, LoopVerifierOptions& options);

}  // namespace placegraph
