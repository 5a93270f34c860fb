#pragma once
#include <placegraph/frontend/features/stereo_matcher.h>
#include <placegraph/frontend/lines/line_options.h>
#include <placegraph/frontend/segments/edge_refinement.h>
#include <placegraph/frontend/segments/segment_flow.h>

#include <optional>
#include <vector>

namespace placegraph {

/// Finds edges of the left image in the right image of a rectified pair.
///
/// Disparities of points along a segment, found by correlation of rows, are affine along it, as the
/// inverse depth of a line is. The consensus of the samples predicts the segment in the right
/// image, where it is aligned across and measured on the gradient of the same polarity. Its ends
/// are those of its support there: only the infinite lines correspond. Nothing for edges that are
/// parallel to the rows (the epipolar lines), are hidden from the right camera, or have negative
/// disparity. Images: CV_8UC1 of one size, else ArgumentError.
std::vector<std::optional<EdgeSegment>> match_stereo_segments(
    const Image& left, const Image& right, const std::vector<LineSegment>& segments_left,
    const StereoMatcherOptions& points, const LineStereoOptions& options);

}  // namespace placegraph
