#pragma once
#include <placegraph/frontend/segments/segment_options.h>
#include <placegraph/frontend/vanishing/vanishing_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/ransac_options.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Tracking of straight edges from frame to frame.
struct LineTrackerOptions {
  SegmentDetectorOptions detector;  ///< detection of edges that become tracks
  SegmentFlowOptions flow;          ///< alignment from frame to frame
  EdgeGrowth growth;                ///< extension of edges
  int max_tracks = 80;              ///< maximum number of edges tracked at once, the longest ones
  double enough_share = 0.75;       ///< share of max_tracks from which on no new edges are searched
  /// Edges that will leave the image soon become tracks only below this share of max_tracks.
  double leaving_share = 0.3;
  double max_shift_px = 12;   ///< maximum distance of a segment from its prediction
  double min_new_px = 25;     ///< minimum length of an edge that becomes a track
  double min_length_px = 20;  ///< minimum length of a track; shorter ones end
  /// Minimum correlation of the strips in two frames, on one side of the edge or both.
  double min_similarity = 0.7;
  /// Maximum error across the edge of its ends tracked forward and back [px].
  double max_forward_backward_px = 1;
  double max_contrast_ratio = 2.5;  ///< maximum ratio of the contrasts in two frames
  void check() const;
};
void visit(OptionVisitor& field, LineTrackerOptions& options);

/// Search for edges of the left image in the right image of a rectified stereo pair.
struct LineStereoOptions {
  SegmentFlowOptions flow;  ///< alignment in the right image
  double min_sine = 0.17;   ///< minimum sine of a segment's angle to the rows; below: no depth
  int samples = 7;          ///< points along a segment whose disparities start the search
  double max_disparity_miss_px = 1.5;  ///< maximum distance of an inlier from the common line
  /// Minimum correlation of the strips in both images, on one side of the edge or both.
  double min_similarity = 0.8;
  void check() const;
};
void visit(OptionVisitor& field, LineStereoOptions& options);

/// Acceptance of a line triangulated from several keyframes.
struct LineTriangulationOptions {
  /// Minimum of the largest angle between the planes through the line and two camera centres.
  double min_rotation_deg = 1.5;
  double min_rotation_sigmas = 8;  ///< minimum ratio of that angle to its standard deviation
  double max_error_sigmas = 4;     ///< maximum residual of an observation [standard deviations]
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, LineTriangulationOptions& options);

/// Pose of a camera from lines in space and their images.
struct PoseFromLinesOptions {
  /// Three-line hypotheses.
  RansacOptions ransac{.max_iterations = 200, .confidence = 0.999, .min_inliers = 6};
  double threshold_px = 2.5;  ///< maximum distance of an inlier from its projection
  /// RANSAC is skipped if this share of the lines are inliers of the predicted pose; above 1:
  /// never.
  double prior_inlier_ratio = 0.6;
  double huber_sigmas = 3;  ///< width of the Huber kernel [standard deviations]
  void check() const;
};
void visit(OptionVisitor& field, PoseFromLinesOptions& options);

/// Initialization of a monocular camera from lines without points.
struct LineInitializerOptions {
  VanishingPointOptions directions;  ///< vanishing points of the first image, for the rotations
  /// Five-line hypotheses of the translations.
  RansacOptions ransac{.max_iterations = 200, .confidence = 0.999, .min_inliers = 9};
  double threshold_px = 3;  ///< maximum residual in the middle image of a line from the others
  /// Minimum rotation of a line's plane for use in the translation.
  double min_rotation_deg = 0.7;
  int min_lines = 12;  ///< minimum number of lines tracked from the first to the last image
  void check() const;
};
void visit(OptionVisitor& field, LineInitializerOptions& options);

/// Selection of the lines on the floor and height of the camera above it.
struct FloorFromLinesOptions {
  double max_tilt_deg = 25;  ///< maximum tilt of the floor from the camera's xz plane
  double upright_deg = 3;    ///< deviation of vertical edges from the floor's normal
  double end_px = 3;         ///< standard deviation of a vertical edge's end from its floor contact
  double unevenness = 0.01;  ///< standard deviation of the floor [camera heights]
  double max_sigma = 0.1;   ///< maximum standard deviation of a height with a vote [camera heights]
  int min_lines = 4;        ///< minimum number of lines on the floor
  double min_share = 0.35;  ///< minimum ratio of the floor's votes to those of the level with most
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, FloorFromLinesOptions& options);

/// Matching of a keyframe's lines to segments near their predicted projection.
struct LineFeatureMatcherOptions {
  int max_distance = 60;     ///< maximum Hamming distance of the descriptors [bits of 256]
  double gate_px = 9;        ///< maximum distance of a segment from its predicted line
  double max_angle_deg = 8;  ///< maximum angle between a segment and its predicted line
  double min_overlap = 0.3;  ///< minimum share of the shorter segment that the other covers
  void check() const;
};
void visit(OptionVisitor& field, LineFeatureMatcherOptions& options);

}  // namespace placegraph
