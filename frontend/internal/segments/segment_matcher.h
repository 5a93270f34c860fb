#pragma once
#include <placegraph/frontend/internal/features/wide_matcher.h>
#include <placegraph/graph/geometry/line_segment.h>

#include <vector>

namespace placegraph {

struct SegmentMatcherOptions {
  WideMatcherOptions points;
  double max_angle_deg = 15;  ///< between a segment and where its line is expected
  double gate_px = 4;         ///< distance from there, where the evidence lies near and agrees
  double min_overlap = 0.3;   ///< of the shorter of two segments with the other
  double min_score = 0.7;     ///< correlation of the strips, less what the distance costs
  double min_lead = 0.05;     ///< of the best score over that of the best rival
  int strip_px = 8;           ///< half width of the strips compared
  int rounds = 3;             ///< each time the lines found help to find the next
  void check() const;
};
void visit(OptionVisitor& field, SegmentMatcherOptions& options);

/// Segments a and b lie on the same line of the scene and show the same part of it.
struct SegmentMatch {
  int a = 0, b = 0;  ///< indices
  double score = 0;  ///< up to 1
};

struct SegmentMatches {
  Outcome outcome;                    ///< kNoConsensus: no geometry joins the images
  std::vector<SegmentMatch> matches;  ///< ascending in a, then b
  int points = 0;                     ///< point pairs that held the geometry
};

/// Matches straight segments between two views that may lie far apart. Points held together by a
/// fundamental matrix, and in later rounds the lines matched so far, tell how the surroundings of a
/// segment move; candidates lie near the line expected there, overlap with it, and correlate with
/// it in a strip on both sides or on one (the other may be hidden). Positions along a line follow
/// the epipolar lines where these cross it (Schmid & Zisserman 1997), else the local motion. A
/// match stays if its neighbours predict it without it. A segment may have several partners where
/// an edge is in pieces: they are then collinear and each shares a part with it.
/// Images: CV_8UC1, else ArgumentError; so if a segment has no length.
SegmentMatches match_segments(const Image& image_a, const std::vector<LineSegment>& a,
                              const Image& image_b, const std::vector<LineSegment>& b,
                              const SegmentMatcherOptions& options);

}  // namespace placegraph
