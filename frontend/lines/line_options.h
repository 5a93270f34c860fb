#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/ransac_options.h>

namespace [[gnu::visibility("default")]] placegraph {

struct SegmentMergingOptions {
  double max_angle_deg = 2;
  double max_distance_px = 1.2;  ///< of the ends of the pieces from the common line
  double max_gap_px = 10;
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, SegmentMergingOptions& options);

struct EdgeRefinementOptions {
  int reach_px = 3;            ///< the edge is looked for so far on both sides
  double blur_px = 1;          ///< of the image before its gradient is taken
  double min_gradient = 2;     ///< grey levels / px, of a point of the edge
  double min_support = 0.5;    ///< share of the segment's samples that see the edge
  double min_sigma_px = 0.03;  ///< across the edge: no sample is better, whatever the fit says
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, EdgeRefinementOptions& options);

/// How far an edge is followed beyond the ends it is expected to have.
struct EdgeGrowth {
  double beyond_px = 6;
  double max_gap_px = 10;  ///< without support, inside one edge
};

struct SegmentDetectorOptions {
  double min_length_px = 15;
  double border_px = 3;  ///< edges that run so near along the border of the image are its own
  SegmentMergingOptions merging;
  EdgeRefinementOptions refinement;
  void check() const;
};
void visit(OptionVisitor& field, SegmentDetectorOptions& options);

struct SegmentFlowOptions {
  int strip_px = 7;          ///< half width of the strip that is followed
  int iterations = 8;        ///< on each level
  double robust_grey = 12;   ///< width of the kernel on grey values, where a side is hidden
  double max_turn_deg = 15;  ///< from the expected direction
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, SegmentFlowOptions& options);

/// How far segments may point past the vanishing point they belong to. Both parts are estimated
/// from the image; these are where the estimate starts.
struct VanishingNoise {
  double end_px = 0.3;        ///< deviation of the ends of a segment, across it
  double parallel_deg = 0.2;  ///< of the edges of the scene and of the camera model from the ideal
  double tail_freedom = 4;    ///< of the errors, Student t: the smaller, the heavier the tails
  void check() const;
};
void visit(OptionVisitor& field, VanishingNoise& noise);

struct VanishingPointOptions {
  VanishingNoise noise;
  int samples = 1000;  ///< of two segments, to begin with; half as many for each later search
  int max_points = 10;
  int min_segments = 4;   ///< a vanishing point with fewer is none
  double point_cost = 8;  ///< of each point beside its precision [nats]: how sure it must be
  void check() const;
};
void visit(OptionVisitor& field, VanishingPointOptions& options);

struct ManhattanOptions {
  /// How far the directions of a scene that is said to be rectangular may be from right angles,
  /// lens and calibration included. How far they are is estimated, up to twice this.
  double orthogonality_deg = 1;
  int min_segments = 4;          ///< of an axis that counts as seen
  double min_evidence = 8;       ///< of each of the two best axes [nats]
  double min_orthogonality = 1;  ///< log of the odds by the angles that the world is rectangular
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, ManhattanOptions& options);

struct SceneDirectionOptions {
  VanishingPointOptions points;
  ManhattanOptions manhattan;
  double off_right_deg = 2;  ///< deviation of further points from right angles to an axis
  double free_share = 0.25;  ///< of further points, that lie anywhere
  void check() const;
};
void visit(OptionVisitor& field, SceneDirectionOptions& options);

struct LineTrackerOptions {
  SegmentDetectorOptions detector;
  SegmentFlowOptions flow;
  EdgeGrowth growth;
  int max_tracks = 80;          ///< the longest edges
  double enough_share = 0.75;   ///< of max_tracks: with so many no new ones are looked for
  double leaving_share = 0.3;   ///< of max_tracks: with fewer, edges that leave soon are begun too
  double max_shift_px = 12;     ///< of a segment from where it is expected
  double min_new_px = 25;       ///< length of an edge that becomes a track
  double min_length_px = 20;    ///< of a track; shorter pieces die
  double min_similarity = 0.7;  ///< correlation of the strips of two frames, of one side or both
  double max_forward_backward_px = 1;  ///< of the ends, across
  double max_contrast_ratio = 2.5;     ///< between two frames
  void check() const;
};
void visit(OptionVisitor& field, LineTrackerOptions& options);

struct LineStereoOptions {
  SegmentFlowOptions flow;
  double min_sine = 0.17;  ///< of a segment's angle to the rows; flatter ones tell no depth
  int samples = 7;         ///< points along a segment whose disparities begin the search
  double max_disparity_miss_px = 1.5;  ///< of a sample that counts, from the common line
  double min_similarity = 0.8;  ///< correlation of the strips of both eyes, of one side or both
  void check() const;
};
void visit(OptionVisitor& field, LineStereoOptions& options);

struct LineTriangulationOptions {
  double min_turn_deg = 1.5;    ///< between the planes through the line and the two farthest eyes
  double min_turn_sigmas = 8;   ///< the same turn, over its own standard deviation
  double max_error_sigmas = 4;  ///< of a sighting from the line, worst of all
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, LineTriangulationOptions& options);

struct PoseFromLinesOptions {
  RansacOptions ransac{.max_iterations = 200, .confidence = 0.999, .min_inliers = 6};
  double threshold_px = 2.5;        ///< inliers lie within this of their projection
  double prior_inlier_ratio = 0.6;  ///< a prior that explains this share spares the RANSAC
  double huber_sigmas = 3;
  void check() const;
};
void visit(OptionVisitor& field, PoseFromLinesOptions& options);

struct LineInitializerOptions {
  VanishingPointOptions directions;  ///< of the first view: rotation is seen by them
  RansacOptions ransac{.max_iterations = 200, .confidence = 0.999, .min_inliers = 9};
  double threshold_px = 3;    ///< of a line of the first and last view, in the one in the middle
  double min_turn_deg = 0.7;  ///< of a line's plane, to take part in the translation
  int min_lines = 12;         ///< seen from the first to the last view
  void check() const;
};
void visit(OptionVisitor& field, LineInitializerOptions& options);

struct FloorFromLinesOptions {
  double max_tilt_deg = 25;  ///< of the floor from the camera's xz plane
  double upright_deg = 3;    ///< deviation of uprights from the floor's normal: built so
  double end_px = 3;         ///< how far an edge's end may lie from where it meets the floor
  double unevenness = 0.01;  ///< of the floor, in heights of the camera
  double max_sigma = 0.1;    ///< of a height, in heights of the camera, to have a vote
  int min_lines = 4;         ///< on the floor
  double min_share = 0.35;   ///< of the votes for the level that has most
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, FloorFromLinesOptions& options);

struct LineFeatureMatcherOptions {
  int max_distance = 60;     ///< bits of 256
  double gate_px = 9;        ///< between a segment and where its line is expected
  double max_angle_deg = 8;  ///< between both
  double min_overlap = 0.3;  ///< of the shorter of two segments with the other, along the line
  void check() const;
};
void visit(OptionVisitor& field, LineFeatureMatcherOptions& options);

}  // namespace placegraph
