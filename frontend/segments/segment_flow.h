#pragma once
#include <placegraph/frontend/segments/segment_options.h>
#include <placegraph/frontend/segments/segment_profile.h>
#include <placegraph/graph/core/options.h>

#include <optional>

namespace placegraph {

/// Maximum rotation of a segment from its predicted direction. Chosen.
inline constexpr double kMaxSegmentRotation_deg = 15;

/// A segment tracked into a second image.
struct SegmentFlow {
  LineSegment segment;  ///< in the second image; its ends correspond as the expected ones do
  LineProfileSimilarity similar;  ///< similarity of the two strips at full size
  double shift_px = 0;            ///< shift of the middle from the prediction
};

/// Tracks a segment of one image into the next.
///
/// Its strip of grey values is aligned by a shift across and a rotation, the two observable motions
/// of a line (aperture problem), with gain and bias, by Gauss-Newton on the mean of both gradients
/// (Benhimane & Malis 2007), from coarse to fine (Lucas & Kanade 1981), with Huber weights. Motion
/// along the line is that of `expected`. Nothing if the strip leaves the image or has no gradient,
/// or the alignment diverges. `coarsest` is the initial number of halvings: about log2 of the error
/// of `expected` [px].
std::optional<SegmentFlow> follow_segment(const LineProfileImage& from, const LineSegment& segment,
                                          const LineProfileImage& to, const LineSegment& expected,
                                          int coarsest);

}  // namespace placegraph
