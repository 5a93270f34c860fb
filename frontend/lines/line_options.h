#pragma once
#include <placegraph/frontend/segments/segment_options.h>
#include <placegraph/frontend/vanishing/vanishing_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/ransac_options.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Tracking of straight edges from frame to frame.
struct LineTrackerOptions {
  SegmentDetectorOptions detector;  ///< detection of edges that become tracks
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
  void check() const;
};
void visit(OptionVisitor& field, PoseFromLinesOptions& options);

/// Initialization of a monocular camera from lines without points.
struct LineInitializerOptions {
  VanishingPointOptions directions;  ///< vanishing points of the first image, for the rotations
  /// Five-line hypotheses of the translations.
  RansacOptions ransac{.max_iterations = 200, .confidence = 0.999, .min_inliers = 9};
  int min_lines = 12;  ///< minimum number of lines tracked from the first to the last image
  void check() const;
};
void visit(OptionVisitor& field, LineInitializerOptions& options);

/// Selection of the lines on the floor and height of the camera above it.
struct FloorFromLinesOptions {
  double max_tilt_deg = 25;  ///< maximum tilt of the floor from the camera's xz plane
  int min_lines = 4;         ///< minimum number of lines on the floor
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, FloorFromLinesOptions& options);

}  // namespace placegraph
