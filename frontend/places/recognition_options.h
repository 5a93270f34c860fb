#pragma once
#include <placegraph/frontend/features/feature_options.h>
#include <placegraph/frontend/lines/line_options.h>
#include <placegraph/frontend/relative_pose/relative_pose_options.h>
#include <placegraph/graph/core/options.h>

namespace [[gnu::visibility("default")]] placegraph {

struct SequenceFilterOptions {
  double memory = 0.9;        ///< weight of the past against the present image
  double pace_penalty = 0.4;  ///< of the score, per squared view a step is off the pace
  int max_step = 3;           ///< views between the answers of two images, at most
  double present = 0.5;       ///< weight of the present image in how sure an answer is
  void check() const;
};
void visit(OptionVisitor& field, SequenceFilterOptions& options);

struct VocabularyOptions {
  int branching = 16;
  int depth = 3;  ///< at most branching^depth words
  int iterations = 5;
  void check() const;
};
void visit(OptionVisitor& field, VocabularyOptions& options);

struct PlaceDatabaseOptions {
  VocabularyOptions vocabulary;
  int first_training = 20;  ///< views after which the first vocabulary is trained
  int max_training_features = 60000;
  void check() const;
};
void visit(OptionVisitor& field, PlaceDatabaseOptions& options);

struct CornerAgreementOptions {
  int width_px = 320;  ///< images are brought to it, smaller ones too
  int max_corners = 300;
  int max_distance = 70;    ///< bits of 256 between two descriptors
  double max_ratio = 0.8;   ///< best over second best distance
  double tolerance = 0.06;  ///< of the width, within which a corner is where it should be
  void check() const;
};
void visit(OptionVisitor& field, CornerAgreementOptions& options);

/// Which cues tell places apart, and how much each counts. A weight of 0 leaves a cue out. The
/// weights make the spread of each cue's similarity over different places about the same; they were
/// chosen together over three sets of images (docs/places.md).
struct PlaceCueOptions {
  double tiny = 1;          ///< the shrunk image itself
  double colour = 1.5;      ///< histograms of hue, saturation and value
  double gradients = 2;     ///< histograms of gradient orientation
  double corners = 0.25;    ///< per e-fold of corners in one similarity beyond corner_floor
  double gabor = 0.15;      ///< statistics of a Gabor filter bank
  int corner_floor = 12;    ///< as many agree by chance
  int tiny_columns = 24;    ///< cells of the shrunk image
  double zoom = 1.25;       ///< a query is also looked at larger and smaller by this
  double shift_loss = 0.1;  ///< of similarity where all of a view lies outside the other
  CornerAgreementOptions corner_agreement;
  void check() const;
};
void visit(OptionVisitor& field, PlaceCueOptions& options);

struct PlaceRecognizerOptions {
  PlaceCueOptions cues;
  int glanced = 300;    ///< views that pass a first look at all, at pooled cues
  int short_list = 60;  ///< of those, the views that are compared in full, after a second look
  int verified = 12;    ///< of those, the first by all cues, whose corners are compared
  int nominated = 8;    ///< and the first by each cue alone
  /// From so many views on, the first look follows a graph of neighbours instead of all views.
  int indexed_from = 20000;
  void check() const;
};
void visit(OptionVisitor& field, PlaceRecognizerOptions& options);

struct LoopTwoViewOptions {
  Pose2d2dOptions pose{.ransac = {.max_iterations = 400, .confidence = 0.9999, .min_inliers = 50},
                       .threshold_px = 1.5};
  Rotation2d2dOptions turn;
  double min_parallax_px = 4;     ///< median displacement that the rotation leaves
  int min_depths = 8;             ///< of one side that must agree on the length of the way
  double max_depth_spread = 0.2;  ///< of their ratios (logarithm) from the median, to agree
  double min_depth_share = 0.6;   ///< of the depths must agree
  void check() const;
};
void visit(OptionVisitor& field, LoopTwoViewOptions& options);

struct LoopVerifierOptions {
  MatcherOptions matcher{.max_distance = 60, .max_ratio = 0.85};
  Pose3d2dOptions pose{.ransac = {.max_iterations = 400, .confidence = 0.9999, .min_inliers = 40},
                       .threshold_px = 3.0,
                       .prior_inlier_ratio = 1.01};
  LoopTwoViewOptions two_view;  ///< where too few points have a depth for `pose`
  LineFeatureMatcherOptions lines;
  double min_inlier_ratio = 0.35;  ///< of the matches that agree with the pose
  double min_spread = 0.03;        ///< share of the image the inliers' box of deviations covers
  double max_scale_error = 0.15;   ///< disagreement of depths seen from both sides
  /// Views that differ more are no revisit: what little calibration and depth are off grows with
  /// it.
  double max_baseline_depths = 0.15;  ///< translation over the median depth of the inliers
  double max_angle_deg = 40;
  void check() const;
};
void visit(OptionVisitor& field, LoopVerifierOptions& options);

}  // namespace placegraph
