#pragma once
#include <placegraph/frontend/features/wide_matcher.h>
#include <placegraph/graph/geometry/line_segment.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Options of the matching of segments across wide baselines.
struct SegmentMatcherOptions {
  WideMatcherOptions points;
  double max_angle_deg = 15;  ///< maximum angle between a segment and its predicted line
  double gate_px = 4;        ///< maximum distance from the prediction for near, consistent evidence
  double min_overlap = 0.3;  ///< minimum share of the shorter segment that the other covers
  double min_score = 0.7;    ///< minimum correlation of the strips minus the cost of the distance
  double min_lead = 0.05;    ///< minimum lead of the best score over that of the best rival
  int strip_px = 8;          ///< half the width of the compared strips
  int rounds = 3;            ///< rounds; the matches of each are evidence for the next
  void check() const;
};
void visit(OptionVisitor& field, SegmentMatcherOptions& options);

/// A match: segments a and b show the same part of a line of the scene.
struct SegmentMatch {
  int a = 0, b = 0;  ///< indices into the two lists
  double score = 0;  ///< at most 1
};

/// Matches of segments between two views.
struct SegmentMatches {
  Outcome outcome;                    ///< kNoConsensus: no epipolar geometry of the images
  std::vector<SegmentMatch> matches;  ///< ascending in a, then b
  int points = 0;                     ///< point pairs of the epipolar geometry
};

/// Matches straight segments between two views with a wide baseline.
///
/// The local motion around a segment is estimated from points with a common fundamental matrix and,
/// in later rounds, from the lines matched so far. Candidates are near the predicted line, overlap
/// with it, and correlate with it in a strip on both sides or on one (the other may be occluded).
/// Positions along a line are from the epipolar lines if these intersect it well (Schmid &
/// Zisserman 1997), else from the local motion. A match is kept if its neighbours alone predict it.
/// A segment may have several partners if an edge is in pieces: they are then collinear and each
/// shares a part with it. Images: CV_8UC1, else ArgumentError; the same if a segment has no length.
SegmentMatches match_segments(const Image& image_a, const std::vector<LineSegment>& a,
                              const Image& image_b, const std::vector<LineSegment>& b,
                              const SegmentMatcherOptions& options);

}  // namespace placegraph
