#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/ransac_options.h>

namespace [[gnu::visibility("default")]] placegraph {

/// When segments are pieces of one edge and are joined.
struct SegmentMergingOptions {
  double max_angle_deg = 2;      ///< largest angle between pieces
  double max_distance_px = 1.2;  ///< largest distance of the pieces' ends from the common line
  double max_gap_px = 10;        ///< longest gap between pieces, along the line
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, SegmentMergingOptions& options);

/// Sub-pixel fit of a segment to the image gradient.
struct EdgeRefinementOptions {
  int reach_px = 3;            ///< how far from the segment the edge is searched, on both sides
  double blur_px = 1;          ///< standard deviation of the blur before the gradient is taken
  double min_gradient = 2;     ///< least gradient of a point of the edge [grey levels / px]
  double min_support = 0.5;    ///< least share of the segment's samples that see the edge
  double min_sigma_px = 0.03;  ///< least standard deviation of a sample across the edge
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, EdgeRefinementOptions& options);

/// How far an edge is followed beyond its predicted ends.
struct EdgeGrowth {
  double beyond_px = 6;    ///< most growth at either end
  double max_gap_px = 10;  ///< longest part of an edge without support
};

/// Detection of straight edges.
struct SegmentDetectorOptions {
  double min_length_px = 15;      ///< shorter edges are left out
  double border_px = 3;           ///< edges along the image border, this near to it, are left out
  SegmentMergingOptions merging;  ///< which pieces are joined to one edge
  EdgeRefinementOptions refinement;  ///< the sub-pixel fit
  void check() const;
};
void visit(OptionVisitor& field, SegmentDetectorOptions& options);

/// Alignment of a segment's strip of grey values in another image.
struct SegmentFlowOptions {
  int strip_px = 7;              ///< half the width of the strip
  int iterations = 8;            ///< Gauss-Newton iterations on each level
  double robust_grey = 12;       ///< width of the Huber kernel on residuals [grey levels of 255]
  double max_rotation_deg = 15;  ///< largest rotation from the predicted direction
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
  VanishingNoise noise;   ///< of the segments
  int samples = 1000;     ///< hypotheses of two segments at first; half as many in later searches
  int max_points = 10;    ///< most vanishing points
  int min_segments = 4;   ///< least number of segments that point to one
  double point_cost = 8;  ///< description length of a point beside its precision [nats]
  void check() const;
};
void visit(OptionVisitor& field, VanishingPointOptions& options);

/// Manhattan frames: three orthogonal directions that many edges share.
struct ManhattanOptions {
  /// Deviation of the directions of a rectangular scene from right angles, lens and calibration
  /// included. The deviation is estimated, up to twice this.
  double orthogonality_deg = 1;
  int min_segments = 4;     ///< least number of segments of an axis that counts as seen
  double min_evidence = 8;  ///< least evidence of each of the two best axes [nats]
  /// Least log odds, by the angles between the axes, that they are orthogonal.
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

/// Straight edges followed from frame to frame.
struct LineTrackerOptions {
  SegmentDetectorOptions detector;  ///< where new tracks come from
  SegmentFlowOptions flow;          ///< alignment from frame to frame
  EdgeGrowth growth;                ///< how far an edge may grow
  int max_tracks = 80;              ///< most edges followed at once, the longest ones
  double enough_share = 0.75;       ///< no new edges are searched with this share of max_tracks
  /// Edges that will leave the image soon become tracks only below this share of max_tracks.
  double leaving_share = 0.3;
  double max_shift_px = 12;   ///< largest distance of a segment from its prediction
  double min_new_px = 25;     ///< least length of an edge that becomes a track
  double min_length_px = 20;  ///< least length of a track; shorter ones end
  /// Least correlation of the strips in two frames, on one side of the edge or both.
  double min_similarity = 0.7;
  /// Largest error, across, of the ends tracked there and back.
  double max_forward_backward_px = 1;
  double max_contrast_ratio = 2.5;  ///< largest ratio of the contrasts in two frames
  void check() const;
};
void visit(OptionVisitor& field, LineTrackerOptions& options);

/// Search for edges of the left image in the right image of a rectified stereo pair.
struct LineStereoOptions {
  SegmentFlowOptions flow;  ///< alignment in the right image
  double min_sine = 0.17;   ///< least sine of a segment's angle to the rows; flatter: no depth
  int samples = 7;          ///< points along a segment whose disparities start the search
  double max_disparity_miss_px = 1.5;  ///< largest distance of an inlier from the common line
  /// Least correlation of the strips in both images, on one side of the edge or both.
  double min_similarity = 0.8;
  void check() const;
};
void visit(OptionVisitor& field, LineStereoOptions& options);

/// When a line in space is known well enough from several keyframes.
struct LineTriangulationOptions {
  /// Least angle between the planes through the line and two camera centres, those that differ
  /// most.
  double min_rotation_deg = 1.5;
  double min_rotation_sigmas = 8;  ///< least ratio of that angle to its standard deviation
  double max_error_sigmas = 4;     ///< largest residual of any observation, in standard deviations
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, LineTriangulationOptions& options);

/// Pose of a camera from lines in space and their images.
struct PoseFromLinesOptions {
  /// Three-line hypotheses.
  RansacOptions ransac{.max_iterations = 200, .confidence = 0.999, .min_inliers = 6};
  double threshold_px = 2.5;  ///< largest distance of an inlier from its projection
  /// RANSAC is left out if this share of the lines are inliers of the predicted pose; above 1:
  /// never.
  double prior_inlier_ratio = 0.6;
  double huber_sigmas = 3;  ///< width of the Huber kernel, in standard deviations
  void check() const;
};
void visit(OptionVisitor& field, PoseFromLinesOptions& options);

/// The first keyframes of a monocular camera that sees lines but no points.
struct LineInitializerOptions {
  VanishingPointOptions directions;  ///< vanishing points of the first image, for the rotations
  /// Five-line hypotheses of the translations.
  RansacOptions ransac{.max_iterations = 200, .confidence = 0.999, .min_inliers = 9};
  double threshold_px = 3;  ///< largest residual, in the middle image, of a line from the others
  double min_rotation_deg =
      0.7;             ///< least rotation of a line's plane to take part in the translation
  int min_lines = 12;  ///< least number of lines tracked from the first to the last image
  void check() const;
};
void visit(OptionVisitor& field, LineInitializerOptions& options);

/// Which lines lie on the floor, and how high the camera is above it.
struct FloorFromLinesOptions {
  double max_tilt_deg = 25;  ///< largest tilt of the floor from the camera's xz plane
  double upright_deg = 3;    ///< deviation of built uprights from the floor's normal
  double end_px = 3;  ///< standard deviation of an upright's end from where it meets the floor
  double unevenness = 0.01;  ///< standard deviation of the floor, in camera heights
  double max_sigma = 0.1;    ///< largest deviation of a height with a vote, in camera heights
  int min_lines = 4;         ///< least number of lines on the floor
  double min_share = 0.35;   ///< least votes for the floor over those for the level with most
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, FloorFromLinesOptions& options);

/// Matching of a keyframe's lines to segments near their predicted projection.
struct LineFeatureMatcherOptions {
  int max_distance = 60;     ///< largest Hamming distance of the descriptors [bits of 256]
  double gate_px = 9;        ///< largest distance of a segment from its predicted line
  double max_angle_deg = 8;  ///< largest angle between both
  double min_overlap = 0.3;  ///< least share of the shorter segment that the other covers
  void check() const;
};
void visit(OptionVisitor& field, LineFeatureMatcherOptions& options);

}  // namespace placegraph
