#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/ransac_options.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Joining of segments that are pieces of one edge.
struct SegmentMergingOptions {
  double max_angle_deg = 2;      ///< maximum angle between pieces
  double max_distance_px = 1.2;  ///< maximum distance of the pieces' ends from the common line
  double max_gap_px = 10;        ///< maximum gap between pieces, along the line
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, SegmentMergingOptions& options);

/// Sub-pixel fit of a segment to the image gradient.
struct EdgeRefinementOptions {
  int reach_px = 3;          ///< search distance for the edge on both sides of the segment
  double blur_px = 1;        ///< standard deviation of the blur before the gradient is taken
  double min_gradient = 2;   ///< minimum gradient of a point of the edge [grey levels / px]
  double min_support = 0.5;  ///< minimum share of the segment's samples at which the edge is found
  double min_sigma_px = 0.03;  ///< minimum standard deviation of a sample across the edge
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, EdgeRefinementOptions& options);

/// Extension of a tracked edge beyond its predicted ends.
struct EdgeGrowth {
  double beyond_px = 6;    ///< maximum growth at either end
  double max_gap_px = 10;  ///< maximum gap without support inside an edge
};

/// Detection of straight edges.
struct SegmentDetectorOptions {
  double min_length_px = 15;  ///< minimum length of an edge
  double border_px = 3;       ///< edges along the image border within this distance are left out
  SegmentMergingOptions merging;     ///< joining of pieces of one edge
  EdgeRefinementOptions refinement;  ///< the sub-pixel fit
  void check() const;
};
void visit(OptionVisitor& field, SegmentDetectorOptions& options);

/// Alignment of a segment's strip of grey values in another image.
struct SegmentFlowOptions {
  int strip_px = 7;              ///< half the width of the strip
  int iterations = 8;            ///< Gauss-Newton iterations on each level
  double robust_grey = 12;       ///< width of the Huber kernel on residuals [grey levels of 255]
  double max_rotation_deg = 15;  ///< maximum rotation from the predicted direction
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, SegmentFlowOptions& options);

/// Noise model of segments and the vanishing points they belong to.
///
/// end_px and parallel_deg are estimated from the image; the values here are the start.
struct VanishingNoise {
  double end_px = 0.3;        ///< standard deviation of the ends of a segment, across it
  double parallel_deg = 0.2;  ///< deviation of the scene's edges, and of the lens, from parallel
  double tail_freedom = 4;    ///< degrees of freedom of the errors (Student t)
  void check() const;
};
void visit(OptionVisitor& field, VanishingNoise& noise);

/// Vanishing points of an image, their number unknown (minimum description length).
struct VanishingPointOptions {
  VanishingNoise noise;   ///< noise of the segments
  int samples = 1000;     ///< initial hypotheses of two segments; later searches use half as many
  int max_points = 10;    ///< maximum number of vanishing points
  int min_segments = 4;   ///< minimum number of segments of a vanishing point
  double point_cost = 8;  ///< description length of a point beside its precision [nats]
  void check() const;
};
void visit(OptionVisitor& field, VanishingPointOptions& options);

/// Manhattan frames: three orthogonal directions that many edges share.
struct ManhattanOptions {
  /// Deviation of the axes of a Manhattan frame from right angles, lens and calibration included.
  /// The deviation is estimated, up to twice this.
  double orthogonality_deg = 1;
  int min_segments = 4;     ///< minimum number of segments of an observed axis
  double min_evidence = 8;  ///< minimum evidence of each of the two best axes [nats]
  /// Minimum log odds, from the angles between the axes, that they are orthogonal.
  double min_orthogonality = 1;
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, ManhattanOptions& options);

/// Vanishing points and Manhattan frames of one image together.
struct SceneDirectionOptions {
  VanishingPointOptions points;  ///< the vanishing points
  ManhattanOptions manhattan;    ///< the Manhattan frames
  /// Standard deviation of further vanishing points from right angles to an axis.
  double off_right_deg = 2;
  double free_share = 0.25;  ///< prior share of further vanishing points in any direction
  void check() const;
};
void visit(OptionVisitor& field, SceneDirectionOptions& options);

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
