#pragma once
#include <placegraph/frontend/features/feature_options.h>
#include <placegraph/frontend/lines/line_options.h>
#include <placegraph/frontend/relative_pose/relative_pose_options.h>
#include <placegraph/graph/core/options.h>

namespace [[gnu::visibility("default")]] placegraph {

/// How the evidence of past images is joined with that of the present one (SequenceFilter).
struct SequenceFilterOptions {
  double memory = 0.9;        ///< factor on the score of the past, per image
  double pace_penalty = 0.4;  ///< loss of score per squared view that a step is off the pace
  int max_step = 3;           ///< most views between the answers to two consecutive images
  double present = 0.5;       ///< weight of the present image alone in an answer's confidence
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

/// Retrieval of keyframes by visual words, with a vocabulary trained during the run.
struct PlaceDatabaseOptions {
  VocabularyOptions vocabulary;       ///< the visual words
  int first_training = 20;            ///< keyframes after which the first vocabulary is trained
  int max_training_features = 60000;  ///< most features that one training uses
  void check() const;
};
void visit(OptionVisitor& field, PlaceDatabaseOptions& options);

/// How many corners of two images match and agree in one similarity transformation.
struct CornerAgreementOptions {
  int width_px = 320;       ///< images are resized to this width, smaller ones too
  int max_corners = 300;    ///< most corners of an image
  int max_distance = 70;    ///< largest Hamming distance of a match [bits of 256]
  double max_ratio = 0.8;   ///< largest ratio of best to second best distance
  double tolerance = 0.06;  ///< largest error of a corner that agrees, as a share of the width
  void check() const;
};
void visit(OptionVisitor& field, CornerAgreementOptions& options);

/// Which cues the appearance of images is compared by, and their weights.
///
/// A weight of 0 leaves a cue out. With the defaults the similarities of all cues spread about
/// equally over different places; they were chosen over three sets of images (docs/places.md).
struct PlaceCueOptions {
  double tiny = 1;          ///< weight of the shrunk image itself
  double colour = 1.5;      ///< weight of histograms of hue, saturation and value
  double gradients = 2;     ///< weight of histograms of gradient orientation
  double corners = 0.25;    ///< weight of log(agreeing corners / corner_floor)
  double gabor = 0.15;      ///< weight of statistics of a Gabor filter bank
  int corner_floor = 12;    ///< corners that agree by chance: so many or fewer count nothing
  int tiny_columns = 24;    ///< width of the shrunk image [px]
  double zoom = 1.25;       ///< a query is also described enlarged and reduced by this factor
  double shift_loss = 0.1;  ///< loss of similarity for a shift by the whole image
  CornerAgreementOptions corner_agreement;  ///< how agreeing corners are counted
  void check() const;
};
void visit(OptionVisitor& field, PlaceCueOptions& options);

/// How PlaceRecognizer searches its stored views.
struct PlaceRecognizerOptions {
  PlaceCueOptions cues;   ///< what views are compared by
  int shortlisted = 300;  ///< views that pass the first, coarsest comparison
  int short_list = 60;    ///< views that pass the second one and are compared in full
  int verified = 12;      ///< views whose corners are compared: the best by all other cues, ...
  int nominated = 8;      ///< ... and the best by each of the others alone
  /// From so many views on, the first comparison searches a graph of neighbours instead of all.
  int indexed_from = 20000;
  void check() const;
};
void visit(OptionVisitor& field, PlaceRecognizerOptions& options);

/// Relative pose of a loop where too few points have a depth: from two images.
struct LoopTwoViewOptions {
  /// Essential matrix or homography.
  Pose2d2dOptions pose{.ransac = {.max_iterations = 400, .confidence = 0.9999, .min_inliers = 50},
                       .threshold_px = 1.5};
  Rotation2d2dOptions turn;       ///< images that differ by a rotation alone
  double min_parallax_px = 4;     ///< least median displacement beside that of the rotation
  int min_depths = 8;             ///< known depths of one keyframe that must agree on the baseline
  double max_depth_spread = 0.2;  ///< largest log ratio of a depth to the median, to agree
  double min_depth_share = 0.6;   ///< least share of the known depths that agree
  void check() const;
};
void visit(OptionVisitor& field, LoopTwoViewOptions& options);

/// Geometric verification of a loop candidate.
struct LoopVerifierOptions {
  /// Matching of the two keyframes' features.
  MatcherOptions matcher{.max_distance = 60, .max_ratio = 0.85};
  /// Pose from points of known depth; min_inliers points and lines must agree in the end.
  Pose3d2dOptions pose{.ransac = {.max_iterations = 400, .confidence = 0.9999, .min_inliers = 40},
                       .threshold_px = 3.0,
                       .prior_inlier_ratio = 1.01};
  LoopTwoViewOptions two_view;      ///< where too few points have a depth for `pose`
  LineFeatureMatcherOptions lines;  ///< lines that the pose predicts in the query
  double min_inlier_ratio = 0.35;   ///< least share of the matches that agree with the pose
  /// Least share of the image that a box of +-2 standard deviations of the inliers covers.
  double min_spread = 0.03;
  /// Largest |log| of the median ratio of the depths that both keyframes know.
  double max_scale_error = 0.15;
  /// Largest translation between the keyframes over the median depth of the inliers: errors of
  /// calibration and depth grow with it.
  double max_baseline_depths = 0.15;
  double max_angle_deg = 40;  ///< largest rotation between the keyframes
  void check() const;
};
void visit(OptionVisitor& field, LoopVerifierOptions& options);

}  // namespace placegraph
