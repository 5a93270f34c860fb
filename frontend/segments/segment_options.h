#pragma once
#include <placegraph/graph/core/options.h>

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

}  // namespace placegraph
