#pragma once
#include <placegraph/frontend/internal/segments/segment_profile.h>
#include <placegraph/frontend/lines/line_options.h>
#include <placegraph/graph/core/options.h>

#include <optional>

namespace placegraph {

struct SegmentFlow {
  LineSegment segment;  ///< in the second image; its ends correspond as the expected ones do
  LineProfileSimilarity similar;  ///< of the two strips, at full size
  double shift_px = 0;            ///< of the middle from where it was expected
};

/// Where a segment of one image lies in the next: its strip of grey values is aligned by a shift
/// across and a turn, the two motions of a line that can be seen (the aperture hides the third),
/// with gain and bias, by Gauss-Newton on the mean of both gradients (Benhimane & Malis 2007), from
/// coarse to fine (Lucas & Kanade 1981), Huber weights. Motion along the line is that of
/// `expected`. Nothing where the strip leaves the image or has no gradient, or the alignment runs
/// away. `coarsest` is the number of halvings begun with: about log2 of the error of `expected`
/// [px].
std::optional<SegmentFlow> follow_segment(const LineProfileImage& from, const LineSegment& segment,
                                          const LineProfileImage& to, const LineSegment& expected,
                                          int coarsest, const SegmentFlowOptions& options);

}  // namespace placegraph
